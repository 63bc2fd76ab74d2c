// Compressed slopes in single precision, for frames.
#pragma once

#include <algorithm>
#include <cmath>

#include "relief/weight_table.h"
#include "relievo/core/parallel.h"
#include "relievo/weights.h"

namespace relievo {

// Equation (5), divided by its z: compressed_slope() in single precision.
inline Vec2f frame_slope(const Vec3f& normal, float w, float max_slope) {
  const float x = -w * normal.x(), y = -w * normal.y(), z = w * normal.z() + (1 - w);
  const float length = std::sqrt(x * x + y * y);
  const float scale = length <= max_slope * z ? 1 / std::max(z, 1e-30F) : max_slope / length;
  return {x * scale, y * scale};
}

// compressed_slopes() with weights from the table.
inline void frame_slopes(const SlopeInput& input, const WeightTable& weight, double max_slope,
                         std::span<Vec2f> slopes) {
  parallel_for(slopes.size(), [&](std::size_t i) {
    slopes[i] = frame_slope(input.normals[i], weight(input.k[i]) * input.boundary_weight[i],
                            static_cast<float>(max_slope));
  });
}

// layered_slopes() with the saturation's share from the table, which holds saturation_alone().
inline void frame_layered_slopes(const SlopeInput& input, const WeightTable& saturation, const Shape& shape,
                                 std::span<Vec2f> slopes) {
  const LayerWeights weights = layer_weights(shape);
  const auto scale = static_cast<float>(saturation_scale(shape.compression));
  const auto max_slope = static_cast<float>(shape.max_slope);
  parallel_for(slopes.size(), [&](std::size_t i) {
    const float share = scale * saturation(input.k[i]) * input.boundary_weight[i];
    slopes[i] = layered_slope(input.layers[i], weights, share, max_slope);
  });
}

}  // namespace relievo
