// Equation (9) written out for fixed points: the matrix, and what the right-hand side takes of the slopes.
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "relief/sliced_ell_matrix.h"
#include "relievo/boundary.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {

struct HeightEquations {
  std::vector<Index> free_points;  // point of each unknown: those that are not on the boundary
  Eigen::SparseMatrix<double> A;   // lower triangle, by unknown: the weighted Laplacian
  // Edges of point i are edges[begin[i]] up to edges[begin[i + 1]], in ascending order of the others;
  // boundary points have one to themselves, too. The right-hand side is their divergence: see PointLinks.
  // Pull: half the weight times the step from the other point; 0 at boundary points, whose heights
  // are 0.
  std::vector<Index> begin = {0};
  std::vector<PointLink> edges;
};

// Weights as for HeightSystem::build().
HeightEquations height_equations(std::span<const Vec2> points, const Triangulation& triangulation,
                                 const Boundary& boundary, std::span<const float> weights = {});

}  // namespace relievo
