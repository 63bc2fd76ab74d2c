// Splits normals into layers by the size of the shapes that they belong to. The layered style compresses
// coarse layers more than fine ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// The x and y of one layer of a normal. Each is clamped to [-2, 2] and stored as an integer in units of
// 1/16384. This needs half the memory of two floats.
class LayerXy {
 public:
  static constexpr float unit = 0x1p-14F;

  LayerXy() = default;
  LayerXy(const Vec2f& xy) : x_(in_units(xy.x())), y_(in_units(xy.y())) {}
  operator Vec2f() const { return unit * Vec2f(static_cast<float>(x_), static_cast<float>(y_)); }

 private:
  static std::int16_t in_units(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value / unit, -32767.F, 32767.F)));
  }

  std::int16_t x_ = 0, y_ = 0;
};

// Band-pass decomposition of -(n_x, n_y): the differences between consecutive Gaussian blurs along the
// surface (standard deviations of 0.45, 5.8 and 12 % of the longer side), and the remainder. The layers sum
// up to faded_xy() of the normal.
struct PointLayers {
  LayerXy fine, middle, coarse, broad;
};

// Returns -(n_x, n_y), faded out where the surface turns away from the viewer: to half at about 85 degrees.
// Slopes there use up height but add little shading.
Vec2f faded_xy(const Vec3f& normal);

// Returns the layers of every point of a surface. Takes about 0.1 s for 180k points.
std::vector<PointLayers> normal_layers(std::span<const Vec3> points, std::span<const Vec3f> normals);

// The share of each layer in a relief: w_k = 1 - exp(-u) of equation (6), times (2 - height_share). The
// second factor compensates for the contrast that the height correction removes.
struct LayerWeights {
  float fine = 0, middle = 0, coarse = 0, broad = 0;
  float height_share = 1;  // see relievo::height_share()

  // Returns the weights for u in [0, infinity]. `detail` >= 0 is Shape::gamma. It multiplies u for the
  // middle, coarse and broad layers by exp(-10 detail), exp(-20.5 detail) and exp(-55 detail); 0 treats all
  // layers alike. `height_share` is in [0, 1].
  static LayerWeights of(double u, double detail, double height_share);
};

}  // namespace relievo
