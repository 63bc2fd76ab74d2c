// A numbering of points in the plane in which near ones are near in memory, too.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the points scaled into [0, 1], so that single precision resolves them; 0 where a coordinate is not
// finite.
std::vector<Eigen::Vector2f> in_unit_square(std::span<const Vec2> points);

// Returns the numbers of the points in Z-order on a grid of 65536 x 65536 over the unit square, those of a
// cell by number.
std::vector<Index> plane_order(std::span<const Eigen::Vector2f> points);

}  // namespace relievo
