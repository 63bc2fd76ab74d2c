// Computes sections of a finished solid.
#pragma once

#include <cstddef>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo::app::studio {

// A line across the front. Its ends are in mm from the middle of the relief or, if a piece is cut, from the
// middle of the piece.
struct SectionLine {
  Vec2 from, to;
  std::size_t samples = 400;  // at least 2
};

// Returns the heights of the solid's highest surface above its ground in mm, in equal steps along the line.
// Beside the solid they are the height of its lowest point.
std::vector<float> section_of(const Solid& solid, const SectionLine& line);

}  // namespace relievo::app::studio
