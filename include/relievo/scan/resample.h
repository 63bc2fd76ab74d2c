// Heights of one surface at the points of another, to compare reliefs that were made from different points.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns the height of the triangles inside `from` at each point of `to`, 0 where there is none. `heights` has one
// value per point of `from`. Both surfaces must show the same cloud in the same direction.
std::vector<double> resampled(std::span<const double> heights, const Surface& from, const Surface& to);

}  // namespace relievo
