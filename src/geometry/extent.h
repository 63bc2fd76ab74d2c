// How far points reach: across the view plane, and in depth.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// The longer side of the points' box in the view plane.
double longer_side_of(std::span<const Vec3> points);

// 0 for the deepest point, below 1 for the nearest: the share of the points that lie deeper, so that equal
// depths have equal ranks.
std::vector<double> depth_ranks(std::span<const Vec3> points);

}  // namespace relievo
