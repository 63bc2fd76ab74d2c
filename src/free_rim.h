// Equation (9) with a free rim: without the boundary points, so that a relief may end in a step.
#pragma once

#include "height_equations.h"
#include "relievo/cholesky.h"
#include "relievo/surface.h"

namespace relievo {

// Over the edges between points that are not on the boundary the least squares of z_p - z_q = (s_p + s_q) / 2
// . (p - q), with cotangent weights; each point is pulled towards a level of its own besides, with a third of
// the area of its triangles over reach^2, so that parts that hang together loosely do not drift apart.
class FreeRimSystem {
 public:
  // `reach` > 0 is in units of the surface. Errors: those of Cholesky::factor(), which a Delaunay
  // triangulation with its boundary does not cause.
  static Result<FreeRimSystem> build(const Surface& surface, double reach);

  // Returns the height of every point, 0 on the boundary. Slopes and levels are given per point; none are 0
  // everywhere.
  std::vector<double> solve(std::span<const Vec2f> slopes, std::span<const double> levels) const;

 private:
  FreeRimSystem(HeightEquations equations, std::vector<double> pull, Cholesky factor);
  double divergence(Index point, std::span<const Vec2f> slopes) const;

  HeightEquations equations_;
  std::vector<double> pull_;  // towards its level, per unknown
  Cholesky factor_;
  std::vector<std::uint8_t> is_boundary_;  // per point
};

}  // namespace relievo
