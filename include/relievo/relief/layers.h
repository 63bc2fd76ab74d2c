// Normals in layers, by the size of what they show: our method compresses coarse layers more than fine ones.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// The x and y of one layer to a part in 16384, in half the memory of floats. What is beyond 2 is 2.
class LayerXy {
 public:
  static constexpr float part = 0x1p-14F;

  LayerXy() = default;
  LayerXy(const Vec2f& xy) : x_(in_parts(xy.x())), y_(in_parts(xy.y())) {}
  operator Vec2f() const { return part * Vec2f(static_cast<float>(x_), static_cast<float>(y_)); }

 private:
  static std::int16_t in_parts(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value / part, -32767.F, 32767.F)));
  }

  std::int16_t x_ = 0, y_ = 0;
};

// What a point's normal is made of. They add up to -(n_x, n_y), less where it is steeper than about 85
// degrees: what a Gaussian along the surface takes away, of 0.45, 5.8 and 12 % of the longer side in a row,
// and what is left.
struct PointLayers {
  LayerXy fine, middle, coarse, broad;
};

// Returns the layers of every point of a surface. About 0.1 s for 180k points.
std::vector<PointLayers> normal_layers(std::span<const Vec3> points, std::span<const Vec3f> normals);

enum class Style {
  paper,   // equations (5) to (7), and detail added to the heights
  layered  // ours: fine layers of the normals kept more than coarse ones, heights held within the relief's
};

// How much of each layer a relief keeps: the paper's w_k = 1 - exp(-u), equation (6), layer by layer, times
// 2 - held, since what the membrane levels shows less.
struct LayerWeights {
  float fine = 0, middle = 0, coarse = 0, broad = 0;
  float held = 1;  // Hold::share

  // u in [0, infinity]. `detail` >= 0 holds the coarser layers back, the coarse one by exp(-20 detail), the
  // broad one by exp(-55 detail); 0 is even. `held` in [0, 1].
  static LayerWeights of(double u, double detail, double held);
};

// How tightly layered heights are held within the relief's.
struct Hold {
  double share = 1;   // of the height that (9) gives the slopes, (0, 1]; at 1 nothing is above the relief's
  double reach = .1;  // of the longer side, > 0: less draws what is in front more to the front

  bool operator==(const Hold&) const = default;
};

// What the layers add up to, each times its weight. All eight numbers at once: a frame does it for every
// point.
inline Vec2f weighted_sum(const PointLayers& layers, const LayerWeights& w) {
  const auto parts = std::bit_cast<std::array<std::int16_t, 8>>(layers);
  const std::array<float, 8> weights{w.fine,   w.fine,   w.middle, w.middle,
                                     w.coarse, w.coarse, w.broad,  w.broad};
  std::array<float, 8> kept;
  for (std::size_t i = 0; i < 8; ++i) kept[i] = weights[i] * static_cast<float>(parts[i]);
  return LayerXy::part *
         Vec2f((kept[0] + kept[2]) + (kept[4] + kept[6]), (kept[1] + kept[3]) + (kept[5] + kept[7]));
}

// The slope that shows the x and y that the weighted layers add up to, times `weight`, once the relief is
// held: if all of it stays that of the normal with this x and y, if little, which leaves surfaces all but
// level, x and y themselves. Shortened to at most `max_slope`.
template <typename Real>
Eigen::Vector2<Real> layered_slope(const PointLayers& layers, const LayerWeights& w, Real weight,
                                   Real max_slope) {
  const Vec2f sum = weighted_sum(layers, w);
  const Real x = weight * static_cast<Real>(sum.x()), y = weight * static_cast<Real>(sum.y());
  const Real sine_sq = x * x + y * y, most_sq = max_slope * max_slope;
  const Real held_sq = sine_sq * static_cast<Real>(w.held * w.held);
  // tan = sin / cos; beyond the steepest slope the length is given instead.
  const Real scale =
      sine_sq <= most_sq * (1 - held_sq) ? 1 / std::sqrt(1 - held_sq) : max_slope / std::sqrt(sine_sq);
  return {x * scale, y * scale};
}

}  // namespace relievo
