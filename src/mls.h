// The moving-least-squares function g of the paper's equation (2), with its first two derivatives.
#pragma once

#include <span>

#include "relievo/core/types.h"

namespace relievo {

struct MlsSample {
  Vec3 d;  // from the neighbour to the place of evaluation
  Vec3 n;  // the neighbour's unit normal
};

struct MlsValue {
  double g = 0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
  bool is_valid = false;  // false if the weighted normals cancel or there are no neighbours
};

// Returns g(x) = n(x) . de(y, n(x))/dy at y = x, equation (2), divided by twice the sum of the weights there
// (constant: g is a distance near the surface), for Gaussian weights exp(-d^2 / h^2).
MlsValue mls_function(std::span<const MlsSample> neighbours, double h);

// Mean curvature of the level set of g, equation (3), halved and signed so that convex is positive: div(g' /
// |g'|) / 2.
double mean_curvature_of_level_set(const Vec3& gradient, const Mat3& hessian);

}  // namespace relievo
