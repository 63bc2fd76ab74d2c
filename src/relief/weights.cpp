#include "relievo/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relievo/core/parallel.h"

namespace relievo {

bool Compression::operator==(const Compression& other) const {
  const bool is_same_curve =
      curve && other.curve ? curve->points() == other.curve->points() : curve == other.curve;
  return u == other.u && beta == other.beta && is_same_curve;
}

Compression Compression::from_alpha(double alpha, double beta) {
  if (beta == 0) return {1, 0};
  return {alpha > 0 ? std::exp(-beta * std::log(alpha)) : std::numeric_limits<double>::infinity(), beta};
}

double Compression::alpha() const {
  if (beta == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::exp(-std::log(u) / beta);
}

namespace {

double tone_weight(double share, double u) {
  if (share <= 0 || u <= 0) return 0;
  return share >= 1 ? 1 : -std::expm1(u * std::log1p(-share));
}

}  // namespace

// Equation (6).
double curvature_weight(double k, double delta, const Compression& compression) {
  const double u = compression.u, beta = compression.beta;
  if (!(delta > 0)) return -std::expm1(-u);
  if (compression.curve) return tone_weight((*compression.curve)(k), u);
  if (beta == 0) return -std::expm1(-u);
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

void compressed_slopes(const SlopeInput& input, const Compression& compression, double max_slope,
                       std::span<Vec2> slopes) {
  parallel_for(slopes.size(), [&](std::size_t i) {
    const double w_k = curvature_weight(static_cast<double>(input.k[i]), input.delta, compression);
    const double w = w_k * static_cast<double>(input.boundary_weight[i]);
    slopes[i] = compressed_slope(input.normals[i].cast<double>(), w, max_slope);
  });
}

Compression saturation_alone(const Compression& compression) {
  Compression alone = compression;
  alone.u = 1;
  return alone;
}

double saturation_scale(const Compression& compression) {
  return compression.curve ? 1 : -1 / std::expm1(-1.0);
}

Shape layered_shape() {
  Shape shape{{1, 0}, .04};
  shape.style = Style::layered;
  shape.boundary_width = .5;
  return shape;
}

LayerWeights layer_weights(const Shape& shape) {
  return LayerWeights::of(shape.compression.u, shape.gamma, shape.hold.value_or(Hold{}).share);
}

void layered_slopes(const SlopeInput& input, const Shape& shape, std::span<Vec2> slopes) {
  const LayerWeights weights = layer_weights(shape);
  const Compression saturation = saturation_alone(shape.compression);
  const double scale = saturation_scale(shape.compression);
  parallel_for(slopes.size(), [&](std::size_t i) {
    const double share = scale * curvature_weight(static_cast<double>(input.k[i]), input.delta, saturation);
    slopes[i] = layered_slope(input.layers[i], weights, share * static_cast<double>(input.boundary_weight[i]),
                              shape.max_slope);
  });
}

std::vector<float> boundary_weights(std::span<const float> distance, double rho) {
  std::vector<float> weights(distance.size());
  parallel_for(weights.size(), [&](std::size_t i) {
    weights[i] = static_cast<float>(boundary_weight(static_cast<double>(distance[i]), rho));
  });
  return weights;
}

}  // namespace relievo
