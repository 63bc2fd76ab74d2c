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
// points, exactly. The matrix does not depend on the slopes: it is factored once. Slopes are (dz/dx, dz/dy).
// Concurrent solves are safe, each with a workspace of its own.
class HeightSystem {
 public:
  // What solves need besides the system, so that they allocate nothing.
  struct Workspace {
    Cholesky::Workspace factor;
    std::vector<float> unknowns;
  };

  // Copies what it needs of its arguments. Errors: those of Cholesky::factor(), which a Delaunay
  // triangulation with its boundary does not cause.
  static Result<HeightSystem> build(std::span<const Vec2> points, const Triangulation& triangulation,
                                    const Boundary& boundary);

  // Number of points, of slopes and of heights.
  std::size_t size() const { return unknown_.size(); }

  // Bytes held.
  std::size_t memory() const;

  Workspace make_workspace() const;

  // Writes the height of every point above the base to `heights`; boundary points get 0. Exact: the residual
  // is at the level of rounding.
  void solve(std::span<const Vec2> slopes, std::span<double> heights) const;

  // The same in single precision, for frames: within about 1e-6 of the span of the heights.
  void solve(std::span<const Vec2f> slopes, std::span<float> heights, Workspace& workspace) const;

 private:
  // An edge from a free point. Its share of the right-hand side is (s_point + s_other) . pull.
  struct Edge {
    Index other;
    Vec2f pull;  // half the cotangent weight times the step from the other point
  };

  explicit HeightSystem(Cholesky factor) : factor_(std::move(factor)) {}
  template <typename Real, typename Slope>
  Real right_hand_side(std::size_t free_point, std::span<const Slope> slopes) const;

  Cholesky factor_;
  std::vector<Index> unknown_;      // per point its number among the unknowns, no_index at the boundary
  std::vector<Index> free_points_;  // the inverse
  std::vector<Index> begin_;        // edges of free point f: edges_[begin_[f]] up to edges_[begin_[f + 1]]
  std::vector<Edge> edges_;
};

}  // namespace relievo
