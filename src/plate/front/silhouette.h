// Finds the silhouette of a relief within its front. Used for plates without ground and to simplify fronts.
// Tested by outline_test and simplify_test.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

using BoundaryEdge = std::array<Index, 2>;  // from, to; seen from +Z, the edge's triangle is on its left

// Returns the edges that belong to only one triangle, in sorted order.
std::vector<BoundaryEdge> boundary_edges(std::span<const Triangle> triangles);

// Returns the front's triangles that are part of the relief; all triangles if `is_relief` is empty.
std::vector<Triangle> relief_triangles(const HeightFieldMesh& front);

// Returns, per triangle of the simplified front `simpler`, whether it is part of the relief. `original` gives, for each
// point of `simpler`, its index in `front`; no_index for new points. `simpler` must contain all points of the relief's
// boundary. If it lacks an edge of this boundary, the centroids of the triangles decide.
std::vector<std::uint8_t> relief_within(const HeightFieldMesh& front, const HeightFieldMesh& simpler,
                                        std::span<const Index> original);

// Returns the relief without its ground. The result has the triangles and points in the given order, but no
// hull. If parts are connected only by a corner, their walls would share an edge; so these parts are
// separated by removing triangles. Connected parts of less than a thousandth of the relief's area are
// removed, too.
HeightFieldMesh relief_alone(const HeightFieldMesh& front);

}  // namespace relievo
