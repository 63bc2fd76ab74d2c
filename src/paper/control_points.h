// Chooses the control points (sections 3.3 and 4.2), a sparse subset of the visible points.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::paper {

// Returns the indices of about 0.6 times `count` points, chosen by region growing. A point is chosen if its distance
// from all points chosen before is at least r2 = sqrt(n1 / n2) r1, where n1 is the number of points, n2 is `count`,
// and r1 is rho. Boundary points come first, so that the boundary is sampled as densely as the rest. If `count` is
// not less than the number of points, all of them are chosen.
std::vector<Index> control_points(std::span<const Vec2> points, std::span<const std::uint8_t> is_boundary,
                                  double rho, std::size_t count);

}  // namespace relievo::paper
