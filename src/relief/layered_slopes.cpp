#include "relief/layered_slopes.h"

#include "relief/style.h"
#include "relief/weight_table.h"

namespace relievo {
namespace {

constexpr std::size_t points_at_once = 8;

// Inputs that are the same for all points.
struct SlopeParams {
  const SlopeInput& input;
  const WeightTable& weight;
  LayerWeights layers;
  float scale, max_slope;
};

// Writes the slopes of points first to first + 7: layered_slope() for each.
RELIEVO_INLINE void write_eight(const SlopeParams& params, std::size_t first, Vec2f* slopes) {
  const LayerWeights& w = params.layers;
  Float8 x, y, weight;
  for (std::size_t k = 0; k < points_at_once; ++k) {
    const std::size_t i = first + k;
    const Vec2f sum = weighted_sum(params.input.layers[i], w);
    x[k] = sum.x(), y[k] = sum.y();
    weight[k] = params.scale * params.weight(params.input.k[i]) * params.input.boundary_weight[i];
  }
  x *= weight, y *= weight;
  make_slopes<EightFloats>(x, y, w.height_share * w.height_share, params.max_slope);
  for (std::size_t k = 0; k < points_at_once; ++k) slopes[first + k] = {x[k], y[k]};
}

RELIEVO_INLINE void write_eights(const SlopeParams& params, std::size_t first, std::size_t end,
                                 Vec2f* slopes) {
  for (std::size_t i = first; i + points_at_once <= end; i += points_at_once) write_eight(params, i, slopes);
}

}  // namespace

void write_slopes_by_eight(const SlopeInput& input, const LayeredStyle& style, const WeightTable& weight,
                           std::span<Vec2f> slopes) {
  const SlopeParams params{input, weight, style.layer_weights(), static_cast<float>(style.scale()),
                           static_cast<float>(style.max_slope())};
  parallel_ranges(slopes.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    RELIEVO_WIDE(write_eights(params, begin, end, slopes.data()));
    for (std::size_t i = begin + (end - begin) / points_at_once * points_at_once; i < end; ++i)
      slopes[i] = style.slope(input, i, weight(input.k[i]), input.boundary_weight[i]);
  });
}

}  // namespace relievo
