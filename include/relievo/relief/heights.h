// Heights (stage 8): the surface that fits given slopes. Paper, equation (9).
#pragma once

#include <memory>
#include <span>

#include "relievo/boundary.h"
#include "relievo/core/progress.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/solver/cholesky.h"

namespace relievo {

class PointLinks;

// Equation (9) for fixed points, written for slopes: over all edges pq of triangles inside the relief, the
// least squares of z_p - z_q = (s_p + s_q) / 2 . (p - q) with cotangent weights, and z = 0 at boundary
// points, exactly. The matrix does not depend on the slopes: it is factored once. Slopes are (dz/dx, dz/dy).
// Concurrent solves are safe, each with a workspace of its own.
class HeightSystem {
 public:
  // What solves need besides the system, so that they allocate nothing.
  using Workspace = Cholesky::Workspace;

  HeightSystem(HeightSystem&&) noexcept;
  HeightSystem& operator=(HeightSystem&&) noexcept;
  ~HeightSystem();

  // Copies what it needs of its arguments. Edges count for the mean of their ends' weights, one per point,
  // in (0, 1]; without weights for 1. Errors: those of Cholesky::factor(), which a Delaunay
  // triangulation with its boundary does not cause.
  static Result<HeightSystem> build(std::span<const Vec2> points, const Triangulation& triangulation,
                                    const Boundary& boundary, std::span<const float> weights = {});

  // Number of points, of slopes and of heights.
  std::size_t size() const;

  // Bytes held.
  std::size_t memory() const;

  Workspace make_workspace() const { return factor_.make_workspace(); }

  // Between neighbours and from boundary points to themselves, for others that link the same points.
  const PointLinks& links() const { return *edges_; }

  // Writes the height of every point above the base to `heights`; boundary points get 0. Exact: the residual
  // is at the level of rounding.
  void solve(std::span<const Vec2> slopes, std::span<double> heights) const;

  // The same in single precision, for frames: within about 1e-6 of the span of the heights.
  void solve(std::span<const Vec2f> slopes, std::span<float> heights, Workspace& workspace) const;

  // Solves for a right-hand side that others wrote, in place and in single precision; boundary points stay as
  // they are.
  void solve_in_place(std::span<float> heights, Workspace& workspace) const;

 private:
  HeightSystem(Cholesky factor, PointLinks edges);

  Cholesky factor_;
  // Pull: half the weight times the step from the other point; 0 at boundary points.
  std::unique_ptr<const PointLinks> edges_;
};

}  // namespace relievo
