// Measures the heights of a solid's front at the centres of the pixels of an image.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "relievo/core/image.h"
#include "relievo/core/types.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"

namespace relievo {

// The resolution of a field, and the part of the front that it shows.
struct FieldSampling {
  int longer_side_px = 0;
  double mm_per_pixel = 0;       // exact size of a pixel; 0: longer_side_px decides
  bool is_relief_alone = false;  // leaves out the rim and the flat ground around the relief
};

// The heights of a solid's front at the pixels of an image. The box is centred in the image. Its longer side
// fills the image. But if the size of a pixel is given, a fraction of a pixel can remain on either side.
struct HeightField {
  double mm_per_pixel = 0;
  Box box;                             // box of the part that is shown
  Image<float> z;                      // millimetres above the box's lowest point; 0 where there is no front
  Image<std::uint8_t> is_beside = {};  // 1 where there is no front; may have no pixels

  Vec2 to_pixels(const Vec3& point) const {
    const Vec3 p = (point - box.centre()) / mm_per_pixel;
    return {z.width / 2.0 + p.x(), z.height / 2.0 - p.y()};
  }
  Vec2 to_mm(double x, double y) const {
    return box.centre().head<2>() + mm_per_pixel * Vec2(x - z.width / 2.0, z.height / 2.0 - y);
  }
};

// Returns a field of zeros for a front with the given box. The field has no pixels if the box is empty, or
// if the number of pixels along a side is not in [1, RasterInput::most_pixels].
HeightField flat_height_field(const Box& box, const FieldSampling& sampling);

// Returns the heights of a solid's front by fast rasterisation. The field has no pixels if
// flat_height_field() returns none.
HeightField draw_height_field(const Solid& solid, int longer_side_px);

// Returns the heights of a solid's front as it is in files, whose coordinates are rounded to single
// precision. A pixel has the height of the highest triangle that contains its centre, edges included.
// (draw_height_field() is less exact. It rounds corners to 1/256 pixel, which at a wall can change a height
// by the height of the wall.) If the relief is shown alone, the field has the height of the ground around it.
// The field has no pixels if flat_height_field() returns none. `is_beside` is empty.
HeightField measure_height_field(const Solid& solid, const FieldSampling& sampling);

// Returns the number of samples along the longer side. The distance between samples is a twelfth of the
// tool's radius, but the number is limited to the range from 2048 to 4096. For a radius of 0 it is 2048.
inline int samples_for(const Tool& tool, double longer_mm) {
  constexpr int least_samples = 2048, most_samples = 4096;
  constexpr double samples_per_radius = 12;
  const double radius = (tool.kind == Tool::Kind::v ? tool.tip_mm : tool.diameter_mm) / 2;
  if (!(radius > 0)) return least_samples;
  const double wanted = longer_mm / radius * samples_per_radius;
  return static_cast<int>(std::clamp<double>(std::ceil(wanted), least_samples, most_samples));
}

// Returns the heights of a solid's front with the given box. They are NaN where there is no front,
// because nothing obstructs the tool there.
inline HeightField front_samples(const Solid& solid, const Box& box, const Tool& tool) {
  HeightField field = draw_height_field(solid, samples_for(tool, box.longer_side()));
  for (std::size_t i = 0; i < field.z.pixels.size(); ++i)
    if (field.is_beside.pixels[i] != 0) field.z.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  return field;
}

}  // namespace relievo
