#include "plate/height_field.h"

#include <algorithm>
#include <cmath>

#include "geometry/raster.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

Box front_box(const Solid& solid) {
  Box box;
  for (std::size_t t = 0; t < solid.front_triangles; ++t)
    for (const Index i : solid.triangles[t]) box.extend(solid.points[i]);
  return box;
}

// Heights count from the lowest point, which keeps their single-precision digits.
Drawing front_scene(const Solid& solid, const HeightField& field) {
  Drawing scene;
  scene.triangles = std::span(solid.triangles).first(solid.front_triangles);
  scene.width = field.width;
  scene.height = field.height;
  scene.points.resize(solid.points.size());
  parallel_for(solid.points.size(), [&](std::size_t i) {
    // Points that the front does not use may lie anywhere.
    const Vec3 p = solid.points[i].cwiseMax(field.box.min).cwiseMin(field.box.max);
    const Vec2 place = field.to_pixels(p);
    scene.points[i] = {place.x(), place.y(), p.z() - field.box.min.z()};
  });
  return scene;
}

}  // namespace

HeightField draw_height_field(const Solid& solid, int longer_side_px) {
  HeightField field;
  field.box = front_box(solid);
  const Vec3 size = field.box.size();
  const double longer_mm = std::max(size.x(), size.y());
  if (longer_side_px < 1 || longer_side_px > Drawing::most_pixels || !(longer_mm > 0)) return field;
  field.mm_per_pixel = longer_mm / longer_side_px;
  const auto pixels = [&](double mm) {
    return std::max(1, static_cast<int>(std::lround(mm / field.mm_per_pixel)));
  };
  field.width = pixels(size.x());
  field.height = pixels(size.y());
  field.z.resize(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height));
  field.is_beside.resize(field.z.size());

  const Drawing scene = front_scene(solid, field);
  const int band_rows = 32;
  const Raster raster(scene, band_rows);
  const auto height = [](const Sample& sample) { return std::max(0.F, sample.z); };
  parallel_for(
      raster.bands(),
      [&](std::size_t b) {
        const Band band = raster.draw(b);
        const auto first = static_cast<std::ptrdiff_t>(band.first_row) * field.width;
        std::ranges::transform(band.samples, field.z.begin() + first, height);
        std::ranges::transform(band.samples, field.is_beside.begin() + first,
                               [](const Sample& sample) { return sample.triangle == no_index; });
      },
      1);
  return field;
}

}  // namespace relievo
