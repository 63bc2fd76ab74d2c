#include "mls.h"

#include <cmath>
#include <vector>

namespace relievo {
namespace {

// The weighted sums from which n(x) and its derivatives come. With the Gaussian theta = exp(-d^2 / h^2) and c
// = 2 / h^2: theta' = -c theta d, theta'' = c theta (c d d^T - I).
struct NormalField {
  Vec3 N = Vec3::Zero();   // sum of theta n, not normalised
  Mat3 dN = Mat3::Zero();  // its derivative
  Mat3 moments[3];         // sum of theta n_a d d^T, for a = x, y, z
  double c = 0;

  NormalField(std::span<const MlsSample> neighbours, std::span<const double> theta, double c_) : c(c_) {
    for (Mat3& m : moments) m.setZero();
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      const auto& [d, n] = neighbours[i];
      const Vec3 weighted = theta[i] * n;
      N += weighted;
      dN -= c * weighted * d.transpose();
      const Mat3 dd = d * d.transpose();
      for (int a = 0; a < 3; ++a) moments[a] += weighted[a] * dd;
    }
  }

  // Second derivative of v . N(x) for a constant v.
  Mat3 second_derivative(const Vec3& v) const {
    return c *
           (c * (v.x() * moments[0] + v.y() * moments[1] + v.z() * moments[2]) - v.dot(N) * Mat3::Identity());
  }
};

}  // namespace

// With u_i = d_i . n(x): de/dy = sum of theta (2 u n - c u^2 d), so g = sum of theta (2 u - c u^3), divided
// here by twice the sum of theta. Below, f(u) = u - c u^3 / 2 and the sums run over the neighbours.
MlsValue mls_function(std::span<const MlsSample> neighbours, double h) {
  const double c = 2 / (h * h);
  std::vector<double> theta(neighbours.size());
  double total = 0;
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    total += theta[i] = std::exp(-neighbours[i].d.squaredNorm() / (h * h));
  const NormalField field(neighbours, theta, c);
  const double length = field.N.norm();
  if (!(length > .1 * total) || neighbours.size() < 4) return {};

  const Vec3 n = field.N / length;
  const Vec3 dlength = field.dN.transpose() * n;                 // gradient of |N|
  const Mat3 J = (field.dN - n * dlength.transpose()) / length;  // derivative of n
  double g = 0;
  Vec3 gradient = Vec3::Zero(), D = Vec3::Zero();  // D = sum of theta f'(u) d
  Mat3 hessian = Mat3::Zero();
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const Vec3& d = neighbours[i].d;
    const double u = d.dot(n), f = u - c * u * u * u / 2, df = 1 - 1.5 * c * u * u, ddf = -3 * c * u;
    const Vec3 du = n + J.transpose() * d, dtheta = -c * d;
    g += theta[i] * f;
    gradient += theta[i] * (f * dtheta + df * du);
    D += theta[i] * df * d;
    const Mat3 mixed = df * (dtheta * du.transpose());
    hessian += theta[i] * (f * c * (c * d * d.transpose() - Mat3::Identity()) + mixed + mixed.transpose() +
                           ddf * du * du.transpose() + df * (J + J.transpose()));
  }
  // What is left of u'': D . n'' for constant D, by the quotient rule on n = N / |N|.
  const Mat3 ddlength =
      (field.dN.transpose() * field.dN - dlength * dlength.transpose()) / length + field.second_derivative(n);
  const Vec3 dDN = field.dN.transpose() * D;
  const double Dn = D.dot(n);
  hessian += (field.second_derivative(D) - Dn * ddlength) / length -
             (dDN * dlength.transpose() + dlength * dDN.transpose()) / (length * length) +
             2 * Dn / (length * length) * dlength * dlength.transpose();
  return {g / total, gradient / total, hessian / total, true};
}

// Equation (3).
double mean_curvature_of_level_set(const Vec3& gradient, const Mat3& hessian) {
  const double length_sq = gradient.squaredNorm(), length = std::sqrt(length_sq);
  if (!(length > 0)) return 0;
  return (length_sq * hessian.trace() - gradient.dot(hessian * gradient)) / (2 * length_sq * length);
}

}  // namespace relievo
