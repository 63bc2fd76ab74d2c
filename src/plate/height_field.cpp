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
RasterInput front_input(const Solid& solid, const HeightField& field) {
  RasterInput input;
  input.triangles = std::span(solid.triangles).first(solid.front_triangles);
  input.width = field.z.width;
  input.height = field.z.height;
  input.points.resize(solid.points.size());
  parallel_for(solid.points.size(), [&](std::size_t i) {
    // Points that the front does not use may lie anywhere.
    const Vec3 p = solid.points[i].cwiseMax(field.box.min).cwiseMin(field.box.max);
    const Vec2 place = field.to_pixels(p);
    input.points[i] = {place.x(), place.y(), p.z() - field.box.min.z()};
  });
  return input;
}

}  // namespace

HeightField flat_height_field(const Box& box, int longer_side_px) {
  HeightField field;
  field.box = box;
  const Vec3 size = box.size();
  const double longer_mm = std::max(size.x(), size.y());
  if (longer_side_px < 1 || longer_side_px > RasterInput::most_pixels || !(longer_mm > 0)) return field;
  field.mm_per_pixel = longer_mm / longer_side_px;
  const auto pixels = [&](double mm) {
    return std::max(1, static_cast<int>(std::lround(mm / field.mm_per_pixel)));
  };
  field.z = filled_image(pixels(size.x()), pixels(size.y()), 0.F);
  return field;
}

HeightField draw_height_field(const Solid& solid, int longer_side_px) {
  HeightField field = flat_height_field(front_box(solid), longer_side_px);
  if (field.z.empty()) return field;
  field.is_beside.resize(field.z.width, field.z.height);
  const RasterInput input = front_input(solid, field);
  const int band_rows = 32;
  const Rasterizer rasterizer(input, band_rows);
  const auto draw_band = [&](std::size_t b) {
    const RowBand band = rasterizer.draw(b);
    const auto first = static_cast<std::ptrdiff_t>(field.z.index(0, band.first_row));
    std::ranges::transform(band.fragments.pixels, field.z.pixels.begin() + first,
                           [](const Fragment& fragment) { return std::max(0.F, fragment.z); });
    std::ranges::transform(band.fragments.pixels, field.is_beside.pixels.begin() + first,
                           [](const Fragment& fragment) { return fragment.triangle == no_index; });
  };
  parallel_for(rasterizer.bands(), draw_band, 1);
  return field;
}

}  // namespace relievo
