// Sorts points along space-filling curves, so that points that follow each other are close to each other.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the indices of the points in the order of a Hilbert curve. Coincident points are in the order of
// their indices. Clusters are resolved at any scale. Coordinates and their differences must be finite.
std::vector<Index> hilbert_order(std::span<const Vec2> points);

// Returns the points, moved and scaled into the unit square, where single precision resolves them. Points
// with a coordinate that is not finite become (0, 0).
std::vector<Eigen::Vector2f> in_unit_square(std::span<const Vec2> points);

// Returns the indices of the points in Z-order on a grid of 65536 x 65536 cells over the unit square. Points
// in the same cell are in the order of their indices.
std::vector<Index> plane_order(std::span<const Eigen::Vector2f> points);

// Returns the indices of the points in Z-order on a grid of 2^63 cells over their box. Points in the same
// cell are ordered by their coordinates. So the resulting sequence of positions does not depend on the order
// of the given points.
std::vector<Index> space_curve_order(std::span<const Vec3> points);

}  // namespace relievo
