#include "pixel_map.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

std::uint16_t to_65535ths(float weight) {
  return static_cast<std::uint16_t>(weight * 65535 + .5F);
}

}  // namespace

void draw_pixel_map(const Drawing& scene, std::span<const Part> parts, PixelMap& map) {
  map.width = scene.width;
  map.height = scene.height;
  const auto columns = static_cast<std::size_t>(scene.width);
  map.pixels.resize(columns * static_cast<std::size_t>(scene.height));
  const Raster raster(scene, 16);
  const auto draw_band = [&](std::size_t b) {
    const Band band = raster.draw(b);
    Pixel* pixel = map.pixels.data() + static_cast<std::size_t>(band.first_row) * columns;
    for (std::size_t i = 0; i < band.samples.size(); ++i, ++pixel) {
      const Sample& sample = band.samples[i];
      *pixel = {};
      if (sample.triangle == no_index) continue;
      pixel->corners = scene.triangles[sample.triangle];
      pixel->part = parts[sample.triangle];
      pixel->z = sample.z;
      if (pixel->part != Part::relief) continue;
      const double x = static_cast<double>(i % columns) + .5;
      const double y = band.first_row + static_cast<double>(i / columns) + .5;
      const Vec3f weights = corner_weights(scene, sample.triangle, x, y);
      pixel->first = to_65535ths(weights[0]);
      pixel->second = to_65535ths(weights[1]);
    }
  };
  parallel_for(raster.bands(), draw_band, 1);
}

}  // namespace relievo
