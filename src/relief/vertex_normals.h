// Vertex normals of a height field (stage 13), prepared for fixed x and y.
#pragma once

#include <span>

#include "relief/sliced_ell_matrix.h"
#include "relievo/boundary.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {

// Returns the links for PointLinks::normals(): the unit normal of each point is that of the sum of the cross
// products of the triangles around it, (0, 0, 1) at points in no triangle. The sum is linear in the heights
// where x and y are fixed. Only triangles inside the relief count.
//
// `like`, if given, has links between neighbours, in ascending order: their pattern is shared.
PointLinks vertex_normal_links(std::span<const Vec2> points, const Triangulation& triangulation,
                               const Boundary& boundary, const PointLinks* like = nullptr);

}  // namespace relievo
