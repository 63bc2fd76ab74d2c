// Minimises a convex quadratic energy under bounds by an interior-point method (Nocedal and Wright, Numerical
// Optimization, 2006, chapter 16.6). Each step factors a new matrix.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo::solver {

// Minimises E(x) under lowest <= x <= highest, where
//   E(x) = 1/2 x^T A x - load^T x   or, if `mass` is the diagonal of a matrix M,
//   E(x) = 1/2 (A x - load)^T M^-1 (A x - load).
// If A is the Laplacian of a triangulation, the first energy is that of a membrane. The second one is that of
// a thin plate. Vectors have an element per unknown.
struct BoundedFit {
  Eigen::SparseMatrix<double> A;  // lower triangle with all diagonal entries; positive semidefinite
  Eigen::VectorXd mass = {};      // > 0, or empty
  Eigen::VectorXd load = {};
  Eigen::VectorXd lowest = {}, highest = {};  // lowest < highest
  std::vector<Vec2> positions = {};  // positions of the unknowns in the plane, for Cholesky::factor()
};

struct BoundedFitResult {
  Eigen::VectorXd x;  // strictly between the bounds
  double energy = 0;  // E(x)
  // No field within the bounds has an energy below E(x) - gap. The gap is the sum over all unknowns of (x - lowest)
  // max(g, 0) + (highest - x) max(-g, 0), where g is the gradient of E. If x satisfies the conditions of Karush, Kuhn
  // and Tucker, all terms are 0.
  double gap = 0;
  int steps = 0;  // number of factorisations
};

// Minimises the energy. Stops when the gap is at most `tolerance` times the larger of |E(x)| and E(0), or
// after 100 steps. Errors: those of Cholesky::factor(), which also occur if the tolerance is below the level
// of rounding errors.
Result<BoundedFitResult> minimise(const BoundedFit& fit, double tolerance);

}  // namespace relievo::solver
