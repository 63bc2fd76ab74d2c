// Interpolates the heights of one surface at the points of another, to compare reliefs of different points.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns the height of the surface `from` at each point of `to`. The height is interpolated in the triangle
// of `from` that contains the point; it is 0 if the boundary of `from` encloses no such triangle. `heights`
// has a height per point of `from`. Both surfaces must show the same cloud in the same direction.
std::vector<double> resampled(std::span<const double> heights, const Surface& from, const Surface& to);

}  // namespace relievo
