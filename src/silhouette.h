// Where a relief ends: for plates without ground, and for making their fronts simpler.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/solid.h"
#include "relievo/triangulation.h"

namespace relievo {

using RimEdge = std::array<Index, 2>;  // with the relief to its left, seen from +Z

// Returns the edges that only one of the triangles has, sorted.
std::vector<RimEdge> rim_of(std::span<const Triangle> triangles);

// Returns the front's triangles that are part of the relief: all, if the front does not tell.
std::vector<Triangle> relief_triangles(const Front& front);

// Returns, per triangle of `mesh`, whether it lies within the rim. `names` are the points' numbers in the
// rim. Empty if an edge of the rim is not in the mesh.
std::vector<std::uint8_t> relief_within(const Triangulation& mesh, std::span<const Index> names,
                                        std::span<const RimEdge> rim);

// Returns the relief without its ground: its triangles and points in their order, no hull. What hangs on by a
// corner only is left out, so that walls meet nowhere; so are pieces below a thousandth of the whole.
Front relief_alone(const Front& front);

}  // namespace relievo
