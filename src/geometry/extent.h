// The extent of points across the view plane and in depth. Tested by
// tests/geometry/extent_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the longer side of the points' box in the view plane; 0 without points.
double longer_side_of(std::span<const Vec3> points);

// Returns for each point the fraction of the points that lie deeper (smaller z): 0 for the deepest, below 1
// for the nearest. Points of equal depth have equal ranks.
std::vector<double> depth_ranks(std::span<const Vec3> points);

}  // namespace relievo
