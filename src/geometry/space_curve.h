// Order of points in space along a Z-order curve. Tested by tests/geometry/extent_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the numbers of the points in Z-order within their box; points in the same of its 2^63 cells are
// ordered by their coordinates. The sequence of positions does not depend on the order in which the points
// are given.
std::vector<Index> space_curve_order(std::span<const Vec3> points);

}  // namespace relievo
