// Computes heights (stage 8): the surface that fits given slopes by our form of the paper's equation (9).
// src/paper/heights.h has the paper's own form.
#pragma once

#include <memory>
#include <span>

#include "relievo/core/progress.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"
#include "relievo/solver/cholesky.h"

namespace relievo {

class SlicedEllMatrix;

// Our equation (9) for a fixed set of points. It fits z_p - z_q to (s_p + s_q) / 2 . (p - q) for all edges pq
// of triangles inside the relief, by least squares with cotangent weights; s is the slope (dz/dx, dz/dy). At
// boundary points z is exactly 0. The matrix does not depend on the slopes and is factored once. Concurrent
// solves are safe if each has its own workspace.
class HeightSystem {
 public:
  // Scratch memory, so that solves allocate nothing.
  using Workspace = solver::Cholesky::Workspace;

  HeightSystem(HeightSystem&&) noexcept;
  HeightSystem& operator=(HeightSystem&&) noexcept;
  ~HeightSystem();

  // Copies the data that it needs from its arguments. `weights` has a weight per point, in (0, 1]; if it is
  // empty, all weights are 1. The weight of an edge is multiplied by the mean weight of its two ends. Errors:
  // those of solver::Cholesky::factor(), which do not occur for a Delaunay triangulation with its boundary.
  static Result<HeightSystem> build(std::span<const Vec2> points, const Triangulation& triangulation,
                                    const Boundary& boundary, std::span<const float> weights = {});

  // Returns the number of points. Slopes and heights have an element per point.
  std::size_t size() const;

  // Returns the number of bytes of memory in use.
  std::size_t memory() const;

  Workspace make_workspace() const { return factor_.make_workspace(); }

  // Returns the matrix that gives the right-hand side from the slopes. It has entries for pairs of neighbours
  // and on the diagonal. Other matrices over the same points reuse its sparsity pattern.
  const SlicedEllMatrix& divergence_matrix() const { return *edges_; }

  // Writes the height of every point above the base to `heights`; boundary points get 0. The solution is
  // exact up to rounding.
  void solve(std::span<const Vec2> slopes, std::span<double> heights) const;

  // Solves in single precision, for frames. The error is about 1e-6 of the range of the heights.
  void solve(std::span<const Vec2f> slopes, std::span<float> heights, Workspace& workspace) const;

  // Solve in place: replace the right-hand side by the heights. Values at boundary points do not change.
  void solve_in_place(std::span<double> heights) const;
  void solve_in_place(std::span<float> heights, Workspace& workspace) const;

 private:
  HeightSystem(solver::Cholesky factor, SlicedEllMatrix edges);

  solver::Cholesky factor_;
  // The coefficient of the right-hand side for a pair of neighbours: half the edge's weight times the vector
  // from the neighbour to the point. Rows of boundary points are 0.
  std::unique_ptr<const SlicedEllMatrix> edges_;
};

}  // namespace relievo
