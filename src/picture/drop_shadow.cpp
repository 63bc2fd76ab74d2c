#include "picture/drop_shadow.h"

#include <algorithm>

#include "geometry/blur.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Soft shadows need few pixels: the longer side of their coarser grid has at most this many cells.
constexpr int most_cells = 160;

// Opacity of the full shadow: as grey as the shadow on a table in a bright room with a lamp.
constexpr float shadow_opacity = .4F;

// The radius of the shadow's soft edge, and the shadow's largest distance from the body, in cells. The values
// suit a plate's thickness.
constexpr int softness = 2;
constexpr float farthest = 2;

class DropShadow {
 public:
  DropShadow(const Image8& picture, const Vec3f& to_lamp) {
    while (std::max(picture.width, picture.height) >> shift_ > most_cells) ++shift_;
    away_ = -farthest * Vec2f(to_lamp.x(), -to_lamp.y());
    const int step = 1 << shift_;
    shade_ = filled_image((picture.width >> shift_) + 2, (picture.height >> shift_) + 2, 0.F);
    for (int y = 0; y * step < picture.height; ++y)
      for (int x = 0; x * step < picture.width; ++x)
        shade_.at(x, y) = static_cast<float>(picture.pixels[picture.index(x * step, y * step) + 3]) / 255;
    for (float& shade : shade_.pixels) shade *= shadow_opacity;
    blur(shade_, softness);
  }

  // Returns the opacity of the shadow at a pixel, interpolated between cells.
  float at(int x, int y) const {
    const float share = 1 / static_cast<float>(1 << shift_);
    const float u = clamped(static_cast<float>(x) * share - away_.x(), shade_.width),
                v = clamped(static_cast<float>(y) * share - away_.y(), shade_.height);
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const float s = u - static_cast<float>(column), t = v - static_cast<float>(row);
    const auto between = [&](int r) {
      const float left = shade_.at(column, r);
      return left + s * (shade_.at(column + 1, r) - left);
    };
    return between(row) + t * (between(row + 1) - between(row));
  }

 private:
  static float clamped(float cell, int cells) {
    return std::clamp(cell, 0.F, static_cast<float>(cells) - 1.001F);
  }

  int shift_ = 0;
  Vec2f away_;  // offset of the shadow, in cells
  Image<float> shade_;
};

// Composites a pixel over black of that opacity.
void lay_over(std::uint8_t* rgba, float shade) {
  const float coverage = static_cast<float>(rgba[3]) / 255, opacity = coverage + (1 - coverage) * shade;
  if (opacity <= 0) return;
  for (int i = 0; i < 3; ++i)
    rgba[i] = static_cast<std::uint8_t>(static_cast<float>(rgba[i]) * (coverage / opacity) + .5F);
  rgba[3] = static_cast<std::uint8_t>(opacity * 255 + .5F);
}

}  // namespace

void add_drop_shadow(Image8& picture, const Vec3f& to_lamp) {
  const DropShadow shadow(picture, to_lamp);
  const auto add_to_row = [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::uint8_t* rgba = &picture.at(0, y);
    for (int x = 0; x < picture.width; ++x, rgba += 4)
      if (rgba[3] < 255) lay_over(rgba, shadow.at(x, y));
  };
  parallel_for(static_cast<std::size_t>(picture.height), add_to_row, 8);
}

}  // namespace relievo
