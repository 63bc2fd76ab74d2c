// Computes sections of a finished solid.
#pragma once

#include <cstddef>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo::app::studio {

// A line across the front. Its ends are in mm from the centre of the relief or, in a section of a piece, from
// the centre of the piece.
struct SectionLine {
  Vec2 from, to;
  std::size_t samples = 400;  // at least 2
};

// Returns the heights of the solid's highest surface above its ground, in mm, at equal distances along the
// line. Outside the solid, the height is that of its lowest point.
std::vector<float> section_of(const Solid& solid, const SectionLine& line);

}  // namespace relievo::app::studio
