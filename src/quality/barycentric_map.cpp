#include "quality/barycentric_map.h"

#include <algorithm>
#include <cmath>

#include "geometry/raster.h"
#include "relievo/core/parallel.h"

namespace relievo {

BarycentricMap::BarycentricMap(std::span<const Vec3> points, const Triangulation& triangulation,
                               int longer_side_px, int margin_px) {
  const Box box = Box::of(points);
  const Vec3 size = box.size();
  units_per_pixel_ = box.longer_side() / longer_side_px;
  if (!(units_per_pixel_ > 0)) return;
  const auto pixels = [&](double length) {
    return std::max(1, static_cast<int>(std::ceil(length / units_per_pixel_ - 1e-9))) + 2 * margin_px;
  };
  places_ = filled_image(pixels(size.x()), pixels(size.y()), Place{});

  RasterInput scene{std::vector<Vec3>(points.size()), triangulation.triangles, width(), height()};
  centre_ = box.centre();
  parallel_for(points.size(), [&](std::size_t i) {
    const Vec2 place = to_pixels(points[i]);
    scene.points[i] = {place.x(), place.y(), 0};
  });
  draw_bands(scene, 16, [&](const RowBand& band) {
    for (int y = 0; y < band.fragments.height; ++y)
      for (int x = 0; x < width(); ++x) {
        const Index t = band.fragments.at(x, y).triangle;
        const int row = band.first_row + y;
        if (t != no_index)
          places_.at(x, row) = {t, triangulation.triangles[t], corner_weights(scene, t, x + .5, row + .5)};
      }
  });
}

}  // namespace relievo
