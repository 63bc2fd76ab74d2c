// Computes normal space compression: the share of each normal in the relief, by equations (5) to (7) of the
// paper. All methods except Method::paper use it in the form of this header. src/paper/compression.h has the
// weights of Method::paper, which follow the paper to the letter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/relief/layers.h"
#include "relievo/relief/shape.h"

namespace relievo {

// Returns w_k of equation (6), in [0, 1]: 1 - exp(-(|k| / (alpha delta))^beta) = 1 - exp(-u (|k| /
// delta)^beta). Never overflows. If delta is 0 (no curvature anywhere), all points get the same weight, as
// for beta = 0.
double curvature_weight(double k, double delta, const Compression& compression);

// Returns w_b of equation (7), in [0, 1]: 1 - exp(-(distance / (2 rho))^2).
double boundary_weight(double distance, double rho);

// Returns w_b for each distance from the boundary.
std::vector<float> boundary_weights(std::span<const float> distance, double rho);

// Returns the slope (dz/dx, dz/dy) of the compressed normal w n + (1 - w) (0, 0, 1) of equation (5),
// shortened to at most `max_slope`. The normal is a unit vector with z >= 0.
template <typename Real>
Eigen::Vector2<Real> compressed_slope(const std::type_identity_t<Eigen::Vector3<Real>>& normal, Real w,
                                      std::type_identity_t<Real> max_slope) {
  const Real x = -w * normal.x(), y = -w * normal.y(), z = w * normal.z() + (1 - w);
  const Real length = std::sqrt(x * x + y * y);
  const auto scaled = [&](Real scale) { return Eigen::Vector2<Real>(x * scale, y * scale); };
  if (!(length <= max_slope * z)) return scaled(max_slope / length);
  // Frames multiply by the reciprocal, because one division is faster than two.
  if constexpr (std::is_same_v<Real, float>) return scaled(1 / std::max(z, 1e-30F));
  return length > 0 ? Eigen::Vector2<Real>(x / z, y / z) : Eigen::Vector2<Real>(0, 0);
}

// The inputs of slopes, one element per point.
struct SlopeInput {
  std::span<const Vec3f> normals;
  std::span<const float> k;                  // normalised mean curvature
  std::span<const float> boundary_weight;    // w_b of equation (7)
  double delta = 0;                          // standard deviation of |k|
  std::span<const PointLayers> layers = {};  // only for the layered style
  std::span<const float> contrast = {};      // local_contrast() of the shape's light; empty without a light
  std::span<const std::uint16_t> attention =
      {};  // the result of levels_of(); empty if the shape has no attention
};

// Writes the target slope of every point. For Style::paper_weights it is compressed_slope() with w = w_k w_b.
// For the layered style it is layered_slope() with layer_weights(shape); the layers are also multiplied by
// w_b and by the factor of the saturation, and the slopes are adapted to the shape's light, if any.
void find_slopes(const SlopeInput& input, const Shape& shape, std::span<Vec2> slopes);

// Return the layer weights of a layered shape: the first function for points of mean attention, the second
// for points whose attention is above the mean by `more_attention`.
LayerWeights layer_weights(const Shape& shape);
LayerWeights layer_weights(const Shape& shape, double more_attention);

// Separate the saturation from a compression c. In the layered style, the saturation or tone curve multiplies
// layers by saturation_scale(c) times w_k of saturation_alone(c). This product is 1 for saturation 0.
Compression saturation_alone(const Compression& compression);
double saturation_scale(const Compression& compression);

}  // namespace relievo
