// Samples a front finely enough to find the parts that a tool reaches.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "plate/height_field.h"
#include "relievo/plate/tool.h"

namespace relievo {

// Returns the number of samples along the longer side, in [2048, 4096]: they are a twelfth of the tool's
// radius apart if that range allows it.
inline int samples_for(const Tool& tool, double longer_mm) {
  constexpr int least_samples = 2048, most_samples = 4096;
  constexpr double samples_per_radius = 12;
  const double radius = (tool.kind == Tool::Kind::v ? tool.tip_mm : tool.diameter_mm) / 2;
  if (!(radius > 0)) return least_samples;
  const double wanted = longer_mm / radius * samples_per_radius;
  return static_cast<int>(std::clamp<double>(std::ceil(wanted), least_samples, most_samples));
}

// Returns the heights of a solid's front, whose box is given; NaN beside the front, where nothing hinders the
// tool.
inline HeightField front_samples(const Solid& solid, const Box& box, const Tool& tool) {
  HeightField field = draw_height_field(solid, samples_for(tool, box.longer_side()));
  for (std::size_t i = 0; i < field.z.pixels.size(); ++i)
    if (field.is_beside.pixels[i] != 0) field.z.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  return field;
}

}  // namespace relievo
