// Computes the weights and expected normals of normal space compression (section 3.3), equations (5) to (7).
#pragma once

#include <cmath>
#include <limits>

#include "relievo/core/types.h"

namespace relievo::paper {

// The coefficients of (6), for height and saturation, and two constants.
struct Coefficients {
  // u = alpha^-beta replaces alpha in (6) and gives the same weights. If beta is 0, alpha has no effect, but
  // u can still give every height. Infinity corresponds to alpha = 0.
  double u = 1;
  double beta = .01;
  double max_slope = 4;       // largest slope of an expected normal; 4 is 76 degrees
  double boundary_width = 2;  // width of the boundary in (7), in rho
};

// Returns the weight w_k of equation (6): 1 - exp(-(|k| / (alpha delta))^beta). `delta` is the standard deviation of
// |k|; if it is 0, all points get the weight for beta = 0.
inline double curvature_weight(double k, double delta, const Coefficients& c) {
  if (c.u == std::numeric_limits<double>::infinity()) return 1;
  const double power = delta > 0 ? std::pow(std::abs(k) / delta, c.beta) : 1;
  return 1 - std::exp(-c.u * power);
}

// Returns the weight w_b of equation (7): 1 - exp(-(distance / width)^2). The paper's width is 2 rho.
inline double boundary_weight(double distance, double width) {
  return 1 - std::exp(-(distance / width) * (distance / width));
}

// Returns the expected normal of equation (5), with w = w_k w_b.
inline Vec3 expected_normal(const Vec3& normal, double w) {
  return w * normal + (1 - w) * Vec3::UnitZ();
}

// Returns the slope (dz/dx, dz/dy) of a surface with this normal, which may have any length. Slopes longer than
// `max_slope` are shortened to this length. The limit is needed because the paper's matrix in (9) is constant only if
// each row is divided by the z of the expected normal, 1 - w (1 - n_z). This z is 1 on the boundary, but goes
// to 0 where w is near 1 and the surface turns away from the viewer, as beside depth jumps.
inline Vec2 slope_of(const Vec3& normal, double max_slope) {
  const double length = normal.head<2>().norm();
  if (!(length <= max_slope * normal.z())) return -max_slope / length * normal.head<2>();
  return length > 0 ? Vec2(-normal.head<2>() / normal.z()) : Vec2(Vec2::Zero());
}

}  // namespace relievo::paper
