// An order of points in which neighbours in the list are neighbours in the plane.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the numbers of the points in the order in which a Hilbert curve passes them, points at the same
// place by number. Clusters are resolved at any scale. Coordinates must be finite, their differences too.
std::vector<Index> hilbert_order(std::span<const Vec2> points);

}  // namespace relievo
