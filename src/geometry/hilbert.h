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

}  // namespace relievo
