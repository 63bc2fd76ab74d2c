// Interpolates the heights of one surface at the points of another, to compare reliefs of different points.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns for each point of `to` the height of the triangle inside the boundary of `from` at that place; 0
// where there is no such triangle. `heights` has a height per point of `from`. Both surfaces must show the
// same cloud in the same direction.
std::vector<double> resampled(std::span<const double> heights, const Surface& from, const Surface& to);

}  // namespace relievo
