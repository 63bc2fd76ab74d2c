#include "relief/layered_slopes.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/simd.h"

namespace relievo {
namespace {

constexpr std::size_t points_at_once = 8;

typedef std::int16_t Short8 __attribute__((vector_size(16)));
static_assert(sizeof(Short8) == sizeof(PointLayers));

// Inputs that are the same for all points.
struct SlopeParams {
  const SlopeInput& input;
  const WeightTable& weight;
  LayerWeights layers;
  float scale, max_slope;
};

// Writes the slopes of points first to first + 7: layered_slope() for each, whose comments explain it.
RELIEVO_INLINE void write_eight(const SlopeParams& params, std::size_t first, Vec2f* slopes) {
  const LayerWeights& w = params.layers;
  const Float8 shares{w.fine, w.fine, w.middle, w.middle, w.coarse, w.coarse, w.broad, w.broad};
  Float8 x, y, weight;
  for (std::size_t k = 0; k < points_at_once; ++k) {
    const std::size_t i = first + k;
    Short8 parts;
    std::memcpy(&parts, &params.input.layers[i], sizeof parts);
    const Float8 kept = shares * __builtin_convertvector(parts, Float8);
    x[k] = LayerXy::unit * ((kept[0] + kept[2]) + (kept[4] + kept[6]));
    y[k] = LayerXy::unit * ((kept[1] + kept[3]) + (kept[5] + kept[7]));
    weight[k] = params.scale * params.weight(params.input.k[i]) * params.input.boundary_weight[i];
  }
  x *= weight, y *= weight;
  const Float8 sine_sq = x * x + y * y, left_sq = sine_sq * (w.height_share * w.height_share);
  const float most_sq = params.max_slope * params.max_slope;
  Float8 cosine, sine;
  for (std::size_t k = 0; k < points_at_once; ++k) cosine[k] = std::sqrt(1 - left_sq[k]);
  for (std::size_t k = 0; k < points_at_once; ++k) sine[k] = std::sqrt(sine_sq[k]);
  const Float8 scale = sine_sq <= most_sq * (1 - left_sq) ? 1 / cosine : params.max_slope / sine;
  x *= scale, y *= scale;
  for (std::size_t k = 0; k < points_at_once; ++k) slopes[first + k] = {x[k], y[k]};
}

RELIEVO_INLINE void write_eights(const SlopeParams& params, std::size_t first, std::size_t end,
                                 Vec2f* slopes) {
  for (std::size_t i = first; i + points_at_once <= end; i += points_at_once) write_eight(params, i, slopes);
}

RELIEVO_AVX2 void write_eights_avx2(const SlopeParams& params, std::size_t first, std::size_t end,
                                    Vec2f* slopes) {
  write_eights(params, first, end, slopes);
}

void write_eights_plain(const SlopeParams& params, std::size_t first, std::size_t end, Vec2f* slopes) {
  write_eights(params, first, end, slopes);
}

}  // namespace

void write_slopes_by_eight(const SlopeInput& input, const LayeredStyle& style, const WeightTable& weight,
                           std::span<Vec2f> slopes) {
  const SlopeParams params{input, weight, style.layer_weights(), static_cast<float>(style.scale()),
                           static_cast<float>(style.max_slope())};
  parallel_ranges(slopes.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    (uses_avx2() ? write_eights_avx2 : write_eights_plain)(params, begin, end, slopes.data());
    for (std::size_t i = begin + (end - begin) / points_at_once * points_at_once; i < end; ++i)
      slopes[i] = style.slope(input, i, weight(input.k[i]), input.boundary_weight[i]);
  });
}

}  // namespace relievo
