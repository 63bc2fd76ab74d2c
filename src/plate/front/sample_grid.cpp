#include "plate/front/sample_grid.h"

#include <algorithm>

#include "relievo/core/parallel.h"

namespace relievo {

SampleGrid sample_grid(const HeightFieldMesh& front, double step, int block) {
  const Box box = Box::of(front.points);
  SampleGrid grid;
  grid.step = std::max(step, box.longer_side() / (RasterInput::most_pixels - 16));
  // Sides are often whole numbers of steps. The added fraction keeps rounding errors from changing the number
  // of cells.
  const auto cells = [&](double mm) { return (static_cast<int>(mm / grid.step + .37) / block + 1) * block; };
  grid.corner = {box.min.x(), box.max.y()};
  grid.input.width = cells(box.size().x());
  grid.input.height = cells(box.size().y());
  grid.input.triangles = front.triangles;
  for (const Vec3& p : front.points) {
    const Vec2 place = grid.pixel(p.head<2>());
    grid.input.points.emplace_back(place.x(), place.y(), 0);
  }
  // In pictures y points down, which reverses the orientation of triangles.
  grid.triangle = filled_image(grid.input.width, grid.input.height, no_index);
  draw_bands(grid.input, 32, [&](const RowBand& band) {
    const auto first = static_cast<std::ptrdiff_t>(grid.triangle.index(0, band.first_row));
    std::ranges::transform(band.fragments.pixels, grid.triangle.pixels.begin() + first,
                           [](const Fragment& f) { return f.triangle; });
  });
  return grid;
}

}  // namespace relievo
