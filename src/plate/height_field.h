// The front of a solid as heights under the centres of a picture's pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Row-major, first row at the top. The front's box lies in the picture's middle, the longer side fills it.
struct HeightField {
  int width = 0, height = 0;
  double mm_per_pixel = 0;
  Box box;                                   // of the front
  std::vector<float> z;                      // millimetres above the front's lowest point; 0 beside the front
  std::vector<std::uint8_t> is_beside = {};  // per pixel: shows no front; empty if all do

  Vec2 to_pixels(const Vec3& point) const {
    const Vec3 p = (point - box.centre()) / mm_per_pixel;
    return {width / 2.0 + p.x(), height / 2.0 - p.y()};
  }
};

// Returns the heights with a longer side of `longer_side_px` pixels; without pixels if that is not in
// [1, Drawing::most_pixels] or the front is empty.
HeightField draw_height_field(const Solid& solid, int longer_side_px);

}  // namespace relievo
