// The control points (sections 3.3 and 4.2): a sparse subset of the visible points.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::paper {

// Returns the indices of about two thirds of `count` points, chosen by growing regions: each point that is no nearer
// than r2 = sqrt(n1 / n2) r1 to those chosen before is chosen, where n1 is the number of points, n2 is
// `count`, and r1 is rho. Boundary points are asked first, so that the boundary is sampled as densely as the
// rest. All points are chosen if `count` is not less than their number.
std::vector<Index> control_points(std::span<const Vec2> points, std::span<const std::uint8_t> is_boundary,
                                  double rho, std::size_t count);

}  // namespace relievo::paper
