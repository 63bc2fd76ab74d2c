// Where a relief ends: for plates without ground, and for making their fronts simpler.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

using RimEdge = std::array<Index, 2>;  // with the relief to its left, seen from +Z

// Returns the edges that only one of the triangles has, sorted.
std::vector<RimEdge> rim_of(std::span<const Triangle> triangles);

// Returns the front's triangles that are part of the relief: all, if the front does not tell.
std::vector<Triangle> relief_triangles(const Front& front);

// Returns, per triangle of a simpler front, whether it is relief in the front it was made of. `names` are its
// points' numbers there, no_index for new ones. It has all points of the rim; where an edge of the rim is
// not one of its own, the middle of a triangle decides.
std::vector<std::uint8_t> relief_within(const Front& front, const Front& simpler,
                                        std::span<const Index> names);

// Returns the relief without its ground: its triangles and points in their order, no hull. What hangs on by a
// corner only is left out, so that walls meet nowhere; so are pieces below a thousandth of the whole.
Front relief_alone(const Front& front);

}  // namespace relievo
