// Heights of one surface at the points of another, for comparing reliefs of different points.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns the height of the inside triangles of `from` at each point of `to`; 0 where there is none.
// `heights` has a height per point of `from`. Both surfaces must show the same cloud in the same direction.
std::vector<double> resampled(std::span<const double> heights, const Surface& from, const Surface& to);

}  // namespace relievo
