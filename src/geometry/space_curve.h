// Order along a space-filling (Z-order) curve.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the numbers of the points in Z-order within their box; points in the same of 2^63 cells by their
// coordinates. The result does not depend on the order given, but for exact twins.
std::vector<Index> space_curve_order(std::span<const Vec3> points);

}  // namespace relievo
