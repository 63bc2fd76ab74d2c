// Computes the slopes of the layered style, for one point or for eight points at once. Tested by
// tests/relief/layers_test.cpp and tests/relief/layered_slopes_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/simd.h"
#include "relievo/relief/layers.h"

namespace relievo {

// Returns the weighted sum of a point's layers. Multiplies all eight numbers of the four layers at once.
RELIEVO_INLINE Vec2f weighted_sum(const PointLayers& layers, const LayerWeights& w) {
  typedef std::int16_t Short8 __attribute__((vector_size(16)));
  static_assert(sizeof(Short8) == sizeof(PointLayers));
  Short8 parts;
  std::memcpy(&parts, &layers, sizeof parts);
  const Float8 weights{w.fine, w.fine, w.middle, w.middle, w.coarse, w.coarse, w.broad, w.broad};
  const Float8 kept = weights * __builtin_convertvector(parts, Float8);
  return LayerXy::unit *
         Vec2f((kept[0] + kept[2]) + (kept[4] + kept[6]), (kept[1] + kept[3]) + (kept[5] + kept[7]));
}

// These types let make_slopes() compute with single numbers or with vectors of eight. Float8 itself cannot
// be the template argument, because GCC would then ignore that it needs no alignment.
template <typename Real>
struct OneNumber {
  using Values = Real;
  static Real root(Real value) { return std::sqrt(value); }
};
struct EightFloats {
  typedef Float8 Values;
  static RELIEVO_INLINE Float8 root(Float8 values) {
    for (int i = 0; i < 8; ++i) values[i] = std::sqrt(values[i]);
    return values;
  }
};

// Turns the weighted layers (x, y) of points into target slopes: (x, y) / sqrt(1 - t^2 (x^2 + y^2)), where t
// is the height share. The root compensates for the tilt that the height correction leaves. At t = 1 the
// result is the slope of the normal with this x and y. Near t = 0, surfaces end up almost level, and the
// result is (x, y). Slopes are shortened to at most `max_slope`.
template <typename Numbers, typename Real>
RELIEVO_INLINE void make_slopes(typename Numbers::Values& x, typename Numbers::Values& y,
                                Real height_share_sq, Real max_slope) {
  const typename Numbers::Values sine_sq = x * x + y * y, left_sq = sine_sq * height_share_sq;
  const Real most_sq = max_slope * max_slope;
  // The first case is the slope, sine / cosine. If this would exceed max_slope, the second case
  // shortens it to max_slope.
  const typename Numbers::Values scale = sine_sq <= most_sq * (1 - left_sq)
                                             ? 1 / Numbers::root(1 - left_sq)
                                             : max_slope / Numbers::root(sine_sq);
  x *= scale, y *= scale;
}

// Returns the target slope of a point. Its weighted layers are multiplied by `weight`.
template <typename Real>
Eigen::Vector2<Real> layered_slope(const PointLayers& layers, const LayerWeights& w, Real weight,
                                   Real max_slope) {
  const Vec2f sum = weighted_sum(layers, w);
  Real x = weight * static_cast<Real>(sum.x()), y = weight * static_cast<Real>(sum.y());
  make_slopes<OneNumber<Real>>(x, y, static_cast<Real>(w.height_share * w.height_share), max_slope);
  return {x, y};
}

}  // namespace relievo
