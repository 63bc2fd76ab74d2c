// Equation (9) written out for fixed points: the matrix, and the coefficients of the right-hand side.
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "relief/sliced_ell_matrix.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"

namespace relievo {

struct HeightEquations {
  std::vector<Index> free_points;  // point of each unknown; points on the boundary have none
  Eigen::SparseMatrix<double> A;   // lower triangle, by unknown: the weighted Laplacian
  // The edges of each point, in ascending order of the other points. Every point has an edge to itself, too,
  // so that vertex_normal_matrix() can reuse the pattern. The coefficient of an edge is half its weight times
  // the step from the other point; it is 0 at boundary points, whose heights are 0. The right-hand side is
  // SlicedEllMatrix::divergence().
  Groups<MatrixEntry> edges;
};

// Returns the equations. `weights` are those of HeightSystem::build().
HeightEquations height_equations(std::span<const Vec2> points, const Triangulation& triangulation,
                                 const Boundary& boundary, std::span<const float> weights = {});

}  // namespace relievo
