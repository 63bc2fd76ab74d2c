// Vertex normals of a height field (stage 13), prepared for fixed x and y.
#pragma once

#include <span>

#include "relief/sliced_ell_matrix.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"

namespace relievo {

// Returns the matrix for SlicedEllMatrix::normals(): the unit normal of each point is that of the sum of the
// cross products of the triangles around it, (0, 0, 1) at points in no triangle. The sum is linear in the
// heights where x and y are fixed. Only triangles inside the relief count.
//
// `like`, if given, must have entries for neighbours in ascending order; its pattern is reused.
SlicedEllMatrix vertex_normal_matrix(std::span<const Vec2> points, const Triangulation& triangulation,
                                     const Boundary& boundary, const SlicedEllMatrix* like = nullptr);

}  // namespace relievo
