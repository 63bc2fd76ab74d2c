#include "relievo/relief/weights.h"

#include <limits>

#include "relief/aimed_slopes.h"
#include "relief/style.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/stroke.h"
#include "relievo/relief/tone_curve.h"

namespace relievo {

bool Compression::operator==(const Compression& other) const {
  const bool is_same_curve =
      curve && other.curve ? curve->points() == other.curve->points() : curve == other.curve;
  return u == other.u && beta == other.beta && is_same_curve;
}

bool SharedStrokes::operator==(const SharedStrokes& other) const {
  return list == other.list || (list && other.list && *list == *other.list);
}

Compression Compression::from_alpha(double alpha, double beta) {
  if (alpha == 0) return {std::numeric_limits<double>::infinity(), beta};
  return {beta == 0 ? 1 : std::exp(-beta * std::log(alpha)), beta};
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

double curvature_weight(double k, double delta, const Compression& compression) {
  const double u = compression.u, beta = compression.beta;
  if (!(delta > 0)) return -std::expm1(-u);
  if (compression.curve) return tone_weight((*compression.curve)(k), u);
  if (beta == 0) return -std::expm1(-u);
  if (k == 0) return 0;
  return -std::expm1(-std::exp(std::log(u) + beta * (std::log(std::abs(k)) - std::log(delta))));
}

double boundary_weight(double distance, double rho) {
  const double ratio = distance / (2 * rho);
  return -std::expm1(-ratio * ratio);
}

void find_slopes(const SlopeInput& input, const Shape& shape, std::span<Vec2> slopes) {
  with_style(shape, [&](const auto& style) {
    const Compression compression = style.weighted();
    const auto w_k = [&](float k) {
      return curvature_weight(static_cast<double>(k), input.delta, compression);
    };
    write_slopes<double>(input, style, w_k, slopes);
  });
  if (shape.light && !input.contrast.empty())
    aim_slopes<double>(shape, input.contrast, static_cast<double>(layer_weights(shape).fine), slopes);
}

Compression saturation_alone(const Compression& compression) {
  Compression alone = compression;
  alone.u = 1;
  return alone;
}

double saturation_scale(const Compression& compression) {
  return compression.curve ? 1 : -1 / std::expm1(-1.0);
}

double usual_height_share(double u) {
  constexpr double least = .4, growth = .2;  // see docs/decisions/height-share.md
  return 1 - (1 - least) * std::exp(-growth * u);
}

double height_share(const Shape& shape) {
  return shape.height_share.value_or(usual_height_share(shape.compression.u));
}

Shape layered_shape() {
  Shape shape{{1, 0}, .04};
  shape.style = Style::layered;
  shape.planes = .07;
  shape.boundary_width = .3;  // a wider soft rim bends the surface at silhouettes: docs/decisions/layers.md
  return shape;
}

LayerWeights layer_weights(const Shape& shape) {
  return LayerWeights::of(shape.compression.u, shape.gamma, height_share(shape));
}

LayerWeights layer_weights(const Shape& shape, double more_attention) {
  const double u = shape.compression.u * std::exp(shape.attention * more_attention);
  const LayerWeights changed = LayerWeights::of(u, shape.gamma, height_share(shape));
  LayerWeights weights = layer_weights(shape);
  weights.fine = changed.fine, weights.middle = changed.middle;
  return weights;
}

std::vector<float> boundary_weights(std::span<const float> distance, double rho) {
  std::vector<float> weights(distance.size());
  parallel_for(weights.size(), [&](std::size_t i) {
    weights[i] = static_cast<float>(boundary_weight(static_cast<double>(distance[i]), rho));
  });
  return weights;
}

}  // namespace relievo
