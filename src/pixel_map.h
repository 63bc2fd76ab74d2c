// Which point of a plate each pixel shows: the part of a live picture that lasts while heights change.
#pragma once

#include <vector>

#include "geometry/raster.h"

namespace relievo {

enum class Part : std::uint8_t { nothing, relief, ground, wall };

// Three corners with their weights in 65535ths, the third weighs the rest.
struct Pixel {
  Triangle corners = {no_index, no_index, no_index};
  std::uint16_t first = 0, second = 0;
  float z = 0;  // towards the viewer, in pixels
  Part part = Part::nothing;

  template <typename T>
  T mean(const T* values) const {
    const float a = static_cast<float>(first) / 65535, b = static_cast<float>(second) / 65535;
    return a * values[corners[0]] + b * values[corners[1]] + (1 - a - b) * values[corners[2]];
  }
};

struct PixelMap {
  int width = 0, height = 0;
  std::vector<Pixel> pixels;  // row-major, first row at the top
};

// Overwrites the map with what is seen of the scene; parts[t] tells what triangle t belongs to.
void draw_pixel_map(const Drawing& scene, std::span<const Part> parts, PixelMap& map);

}  // namespace relievo
