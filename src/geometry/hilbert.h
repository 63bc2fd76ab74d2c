// Order of points along a Hilbert curve: neighbours in the order are neighbours in the plane.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the numbers of the points in the order in which a Hilbert curve passes them; coincident points are
// in the order of their numbers. Clusters are resolved at any scale. Coordinates and their differences must
// be finite.
std::vector<Index> hilbert_order(std::span<const Vec2> points);

// Returns the points moved and scaled into the unit square, so that single precision resolves them. Points
// with a coordinate that is not finite become (0, 0).
std::vector<Eigen::Vector2f> in_unit_square(std::span<const Vec2> points);

// Returns the numbers of the points in Z-order on a grid of 65536 x 65536 cells over the unit square; points
// in one cell are in the order of their numbers.
std::vector<Index> plane_order(std::span<const Eigen::Vector2f> points);

// Returns the numbers of the points in Z-order on a grid of 2^63 cells over their box; points in one cell are
// ordered by their coordinates. The sequence of positions does not depend on the order in which the points
// are given.
std::vector<Index> space_curve_order(std::span<const Vec3> points);

}  // namespace relievo
