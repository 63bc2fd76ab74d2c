// Heights (stage 8): the surface that fits given slopes. Paper, equation (9).
#pragma once

#include <span>
#include <vector>

#include "relievo/boundary.h"
#include "relievo/cholesky.h"
#include "relievo/progress.h"
#include "relievo/triangulation.h"

namespace relievo {

// Equation (9) for fixed points, written for slopes: over all edges pq of triangles inside the relief, the
// least squares of z_p - z_q = (s_p + s_q) / 2 . (p - q) with cotangent weights, and z = 0 at boundary
// points, exactly. The matrix does not depend on the slopes: it is factored once. Concurrent solves are safe.
class HeightSystem {
 public:
  // Copies what it needs of its arguments. Errors: those of Cholesky::factor(), which a Delaunay
  // triangulation with its boundary does not cause.
  static Result<HeightSystem> build(std::span<const Vec2> points, const Triangulation& triangulation,
                                    const Boundary& boundary);

  // Number of points, of slopes and of heights.
  std::size_t size() const { return unknown_.size(); }

  // Writes the height of every point above the base to `heights`; boundary points get 0. Slopes are (dz/dx,
  // dz/dy).
  void solve(std::span<const Vec2> slopes, std::span<double> heights) const;

  // Largest entry of |A x - b| over the largest of |b|, for a solution of solve(): a check.
  double residual(std::span<const Vec2> slopes, std::span<const double> heights) const;

 private:
  struct Edge {
    Index other;   // point at the far end
    float weight;  // cotangent weight
    Vec2 step;     // from the far end to this point
  };

  explicit HeightSystem(Cholesky factor) : factor_(std::move(factor)) {}
  double right_hand_side(Index point, std::span<const Vec2> slopes) const;

  Cholesky factor_;
  std::vector<Index> unknown_;      // per point its number among the unknowns, no_index at the boundary
  std::vector<Index> free_points_;  // the inverse
  std::vector<std::size_t> begin_;  // edges of free point f: edges_[begin_[f]] up to edges_[begin_[f + 1]]
  std::vector<Edge> edges_;
};

}  // namespace relievo
