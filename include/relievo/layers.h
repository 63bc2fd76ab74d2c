// Normals in layers, by the size of what they show: our method compresses coarse layers more than fine ones.
#pragma once

#include <span>
#include <vector>

#include "relievo/types.h"

namespace relievo {

// What a point's normal is made of. They add up to -(n_x, n_y), less where it is steeper than about 85
// degrees: what a Gaussian along the surface takes away, of 0.6, 5.8 and 15 % of the longer side in a row,
// and what is left.
struct PointLayers {
  Vec2f fine = Vec2f::Zero(), middle = Vec2f::Zero(), coarse = Vec2f::Zero(), broad = Vec2f::Zero();
};

// Returns the layers of every point of a surface. About 0.1 s for 180k points.
std::vector<PointLayers> normal_layers(std::span<const Vec3> points, std::span<const Vec3f> normals);

enum class Style {
  paper,   // equations (5) to (7), and detail added to the heights
  layered  // ours: fine layers of the normals kept more than coarse ones, heights held within the relief's
};

// How much of each layer a relief keeps: the paper's w_k = 1 - exp(-u), equation (6), layer by layer.
struct LayerWeights {
  float fine = 0, middle = 0, coarse = 0, broad = 0;
  float held = 1;  // held_share()

  // u in [0, infinity]. `detail` >= 0 holds the coarser layers back, the coarse one by exp(-19 detail), the
  // broad one by exp(-71 detail); 0 is even.
  static LayerWeights of(double u, double detail);
};

// The height within which a layered relief is held, of the one that (9) gives its slopes: the less is kept of
// them, the more of the height is taken. `u` is that of Compression.
double held_share(double u);

// The slope that shows the x and y that the weighted layers add up to, times `weight`, once the relief is
// held: if all of it stays that of the normal with this x and y, if little, which leaves surfaces all but
// level, x and y themselves. Shortened to at most `max_slope`.
template <typename Real>
Eigen::Vector2<Real> layered_slope(const PointLayers& layers, const LayerWeights& w, Real weight,
                                   Real max_slope) {
  const Vec2f sum =
      w.fine * layers.fine + w.middle * layers.middle + w.coarse * layers.coarse + w.broad * layers.broad;
  const Real x = weight * static_cast<Real>(sum.x()), y = weight * static_cast<Real>(sum.y());
  const Real sine_sq = x * x + y * y, most_sq = max_slope * max_slope;
  const Real held_sq = sine_sq * static_cast<Real>(w.held * w.held);
  // tan = sin / cos; beyond the steepest slope the length is given instead.
  const Real scale =
      sine_sq <= most_sq * (1 - held_sq) ? 1 / std::sqrt(1 - held_sq) : max_slope / std::sqrt(sine_sq);
  return {x * scale, y * scale};
}

}  // namespace relievo
