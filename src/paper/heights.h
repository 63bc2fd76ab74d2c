// Computes the heights of the control points (section 3.4): equation (4), in the form of (8) and (9). The paper has
// two equations (9); this is the first.
#pragma once

#include <span>
#include <vector>

#include "core/groups.h"
#include "relievo/core/types.h"
#include "relievo/solver/cholesky.h"

namespace relievo::paper {

// Solves equation (9) as A^T A z = A^T b; A^T A is factored once. A has these rows:
//   z_p = 0                                                 for each boundary point p,
//   z_p - z_q = s_p . ((x, y)_p - (x, y)_q)                 for each point p and each of its neighbours q.
// The neighbours Q of a point are the six points nearest to it in the view plane. Rows of the second kind are (8),
// n~_p . (p - q) = 0, divided by the z of n~_p; s_p is the slope of n~_p. Concurrent solves are safe if each has its
// own workspace.
class NormalEquations {
 public:
  using Workspace = solver::Cholesky::Workspace;

  // Prepares the system for points in the view plane. If a set of points that are connected as neighbours
  // includes no boundary point, the heights of the set would be undetermined. So the point of this set with
  // the lowest index is treated as a boundary point. Errors: those of solver::Cholesky::factor().
  static Result<NormalEquations> build(std::span<const Vec2> points,
                                       std::span<const std::uint8_t> is_boundary);

  std::size_t size() const { return steps_.size(); }
  std::size_t memory() const;
  Workspace make_workspace() const { return factor_.make_workspace(); }

  // Writes the heights above the base, given one slope per point, in single precision.
  void solve(std::span<const Vec2f> slopes, std::span<float> heights, Workspace& workspace) const;

 private:
  struct Row {
    Index p;
    Vec2f step;  // (x, y)_p - (x, y)_q
  };

  explicit NormalEquations(solver::Cholesky factor) : factor_(std::move(factor)) {}

  solver::Cholesky factor_;
  std::vector<Vec2f> steps_;  // per point p: sum of the steps from its neighbours q
  Groups<Row> rows_;          // the rows of (8), grouped by q
};

}  // namespace relievo::paper
