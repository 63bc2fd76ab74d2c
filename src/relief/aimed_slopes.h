// Changes target slopes so that a relief shows a given shading under one given light.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "relievo/core/parallel.h"
#include "relievo/core/types.h"
#include "relievo/relief/light.h"
#include "relievo/relief/shape.h"

namespace relievo {

struct Surface;

// Returns the unit vector towards the light.
Vec3 direction_of(const LightDirection& light);

// Returns the local contrast per point: the Lambert shading of the surface under the light minus a Gaussian
// mean of the shading along the surface. The standard deviation is 3 % of the longer side.
std::vector<float> local_contrast(const Surface& surface, const LightDirection& light);

// Returns the slope whose shading under the light l is `shading`. A shading is the cosine of the angle between normal
// and light, or 0 where the cosine is negative. Across the light's direction in the view plane, the slope has the same
// component as s. If two such slopes exist, the one nearer to s is returned; if none exists, s is returned.
template <typename Real>
Eigen::Vector2<Real> aimed_slope(const Eigen::Vector2<Real>& s, const Eigen::Vector3<Real>& l, Real shading) {
  const Real h = l.template head<2>().norm();
  const Eigen::Vector2<Real> along = l.template head<2>() / h, across(-along.y(), along.x());
  const Real p = s.dot(along), o = s.dot(across);
  // p is the slope along the light, o the slope across it, and h the horizontal length of l. The equation
  // (l_z - h p) / sqrt(1 + p^2 + o^2) = shading, squared, is quadratic in p.
  const Real a = h * h - shading * shading, b = -l.z() * h,
             c = l.z() * l.z() - shading * shading * (1 + o * o);
  const Real root_sq = b * b - a * c;
  if (!(root_sq >= 0) || std::abs(a) < Real(1e-6)) return s;
  Real nearest = p, least = -1;
  for (const Real sign : {Real(-1), Real(1)}) {
    const Real q = (-b + sign * std::sqrt(root_sq)) / a;
    const Real distance = std::abs(q - p);
    if (l.z() - h * q < 0 || (least >= 0 && distance >= least)) continue;
    nearest = q, least = distance;
  }
  return nearest * along + o * across;
}

// Changes the target slopes of a layered shape that has a light, so that their shading gets the given
// contrast. `contrast` is the local_contrast() of the light. It is multiplied by the weight of the fine
// layer. This weight is small in low reliefs, whose slopes have to stay small enough for the height.
template <typename Real>
void aim_slopes(const Shape& shape, std::span<const float> contrast, Real fine_weight,
                std::span<Eigen::Vector2<Real>> slopes) {
  const Eigen::Vector3<Real> l = direction_of(shape.light->from).cast<Real>();
  const Real amount = static_cast<Real>(shape.light->contrast) * fine_weight;
  const Real most = static_cast<Real>(shape.max_slope);
  parallel_for(slopes.size(), [&](std::size_t i) {
    const Real shading = std::clamp(l.z() + amount * static_cast<Real>(contrast[i]), Real(.02), Real(1));
    const Eigen::Vector2<Real> s = aimed_slope<Real>(slopes[i], l, shading);
    const Real length = s.norm();
    slopes[i] = length > most ? Eigen::Vector2<Real>(s * (most / length)) : s;
  });
}

}  // namespace relievo
