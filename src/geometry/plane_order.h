// Order of points along a Z-order curve, so that points that are close in the plane are close in memory.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the points moved and scaled into the unit square, so that single precision resolves them. Points
// with a coordinate that is not finite become (0, 0).
std::vector<Eigen::Vector2f> in_unit_square(std::span<const Vec2> points);

// Returns the numbers of the points in Z-order on a grid of 65536 x 65536 cells over the unit square; points
// in one cell are in the order of their numbers.
std::vector<Index> plane_order(std::span<const Eigen::Vector2f> points);

}  // namespace relievo
