#include "relievo/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relievo {

Compression Compression::from_alpha(double alpha, double beta) {
  if (beta == 0) return {1, 0};
  return {alpha > 0 ? std::exp(-beta * std::log(alpha)) : std::numeric_limits<double>::infinity(), beta};
}

double Compression::alpha() const {
  if (beta == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::exp(-std::log(u) / beta);
}

// Equation (6).
double curvature_weight(double k, double delta, const Compression& compression) {
  const auto& [u, beta] = compression;
  if (beta == 0 || !(delta > 0)) return -std::expm1(-u);
  if (k == 0) return 0;
  return -std::expm1(-std::exp(std::log(u) + beta * (std::log(std::abs(k)) - std::log(delta))));
}

// Equation (7).
double boundary_weight(double distance, double rho) {
  const double ratio = distance / (2 * rho);
  return -std::expm1(-ratio * ratio);
}

// Equation (5), divided by its z.
Vec2 compressed_slope(const Vec3& normal, double w, double max_slope) {
  const double z = w * normal.z() + (1 - w);
  const Vec2 xy = -w * normal.head<2>();
  const double length = xy.norm();
  if (length <= max_slope * z) return length > 0 ? Vec2(xy / z) : Vec2(Vec2::Zero());
  return xy * (max_slope / length);
}

}  // namespace relievo
