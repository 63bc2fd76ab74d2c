// The silhouette of a relief within its front, for plates without ground and for simplifying their fronts.
// Tested by outline_test and simplify_test.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

using BoundaryEdge = std::array<Index, 2>;  // from, to; the triangle lies to the left, seen from +Z

// Returns the edges that belong to one triangle only, sorted.
std::vector<BoundaryEdge> boundary_edges(std::span<const Triangle> triangles);

// Returns the front's triangles that are part of the relief: all of them if `is_relief` is empty.
std::vector<Triangle> relief_triangles(const HeightFieldMesh& front);

// Returns, per triangle of a simplified front, whether it is part of the relief. `original` are the indices
// of its points in the front that it was made of, no_index for new points. The simplified front must have all
// points of the relief's boundary; where one of the boundary's edges is missing, the centroid of a triangle
// decides.
std::vector<std::uint8_t> relief_within(const HeightFieldMesh& front, const HeightFieldMesh& simpler,
                                        std::span<const Index> original);

// Returns the relief without its ground: its triangles and points in their order, without a hull. Triangles
// connected by a corner only are left out, because walls would meet in an edge there. So are connected parts
// of less than a thousandth of the area.
HeightFieldMesh relief_alone(const HeightFieldMesh& front);

}  // namespace relievo
