#include "relief/layered_slopes.h"

#include <algorithm>

#include "relief/style.h"
#include "relief/weight_table.h"
#include "relievo/core/parallel.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

constexpr std::size_t points_at_once = 8;

// Inputs that are the same for all points.
struct SlopeParams {
  const SlopeInput& input;
  const LayeredStyle& style;
  const WeightTable& weight;
  float scale, height_share, max_slope;
};

// Writes layered_slope() for each of the points first to first + 7.
RELIEVO_INLINE void write_eight(const SlopeParams& params, std::size_t first, Vec2f* slopes) {
  Float8 x, y, weight;
  for (std::size_t k = 0; k < points_at_once; ++k) {
    const std::size_t i = first + k;
    const Vec2f sum = weighted_sum(params.input.layers[i], params.style.layer_weights(params.input, i));
    x[k] = sum.x(), y[k] = sum.y();
    weight[k] = params.scale * params.weight(params.input.k[i]) * params.input.boundary_weight[i];
  }
  x *= weight, y *= weight;
  make_slopes<EightFloats>(x, y, params.height_share * params.height_share, params.max_slope);
  for (std::size_t k = 0; k < points_at_once; ++k) slopes[first + k] = {x[k], y[k]};
}

RELIEVO_INLINE void write_eights(const SlopeParams& params, std::size_t first, std::size_t end,
                                 Vec2f* slopes) {
  for (std::size_t i = first; i + points_at_once <= end; i += points_at_once) write_eight(params, i, slopes);
}

// Standard deviations of the Gaussians that separate the layers, as shares of the longer side. docs/method.md
// has the formula, and docs/decisions/layers.md has the reason.
constexpr double fine_sigma = .0045, middle_sigma = .058, coarse_sigma = .12;
// The slope at which faded_xy() halves the x and y of a normal. A slope of 12 corresponds to 85 degrees.
constexpr double half_kept_slope = 12;

// The u of a layer is multiplied by exp(-`attenuation` * detail * share), where the share is `middle_share`,
// `coarse_share` or `broad_share`. At the default detail of 0.04 the exponent is -share. See docs/method.md,
// "Slopes".
constexpr double attenuation = 25, middle_share = .4, coarse_share = .82, broad_share = 2.2;

}  // namespace

void write_slopes_by_eight(const SlopeInput& input, const LayeredStyle& style, const WeightTable& weight,
                           std::span<Vec2f> slopes) {
  const SlopeParams params{input,
                           style,
                           weight,
                           static_cast<float>(style.scale()),
                           static_cast<float>(style.height_share()),
                           static_cast<float>(style.max_slope())};
  parallel_ranges(slopes.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    RELIEVO_WIDE(write_eights(params, begin, end, slopes.data()));
    for (std::size_t i = begin + (end - begin) / points_at_once * points_at_once; i < end; ++i)
      slopes[i] = style.slope(input, i, weight(input.k[i]), input.boundary_weight[i]);
  });
}

Vec2f faded_xy(const Vec3f& normal) {
  const double slope =
      static_cast<double>(normal.head<2>().norm()) / std::max(static_cast<double>(normal.z()), 1e-3);
  return static_cast<float>(-1 / (1 + std::pow(slope / half_kept_slope, 8))) * normal.head<2>();
}

std::vector<PointLayers> normal_layers(std::span<const Vec3> points, std::span<const Vec3f> normals) {
  std::vector<PointLayers> layers(points.size());
  const double longer_side = Box::of(points).longer_side();
  if (!(longer_side > 0)) return layers;
  std::vector<Vec2f> kept(points.size());
  parallel_for(kept.size(), [&](std::size_t i) { kept[i] = faded_xy(normals[i]); });
  const auto blurred = [&](std::vector<Vec2f> values, double sigma) {
    SurfaceBlur(points, sigma * longer_side).apply(values);
    return values;
  };
  const std::vector<Vec2f> smooth = blurred(kept, fine_sigma), smoother = blurred(smooth, middle_sigma),
                           smoothest = blurred(smoother, coarse_sigma);
  parallel_for(layers.size(), [&](std::size_t i) {
    layers[i] = {Vec2f(kept[i] - smooth[i]), Vec2f(smooth[i] - smoother[i]),
                 Vec2f(smoother[i] - smoothest[i]), smoothest[i]};
  });
  return layers;
}

LayerWeights LayerWeights::of(double u, double detail, double height_share) {
  const auto kept = [&](double share) {
    return static_cast<float>(
        u > 0 ? (height_share - 2) * std::expm1(-u * std::exp(-attenuation * detail * share)) : 0);
  };
  return {kept(0), kept(middle_share), kept(coarse_share), kept(broad_share),
          static_cast<float>(height_share)};
}

}  // namespace relievo
