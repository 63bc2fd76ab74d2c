#include "quality/model_picture.h"

#include <cmath>

#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {

ModelPicture::ModelPicture(const Surface& surface, int longer_side_px, int margin_px)
    : grid(surface.points, surface.triangulation, longer_side_px, margin_px) {
  if (grid.pixels() == 0) return;
  classify(surface);
  draw(surface);
}

void ModelPicture::classify(const Surface& surface) {
  const std::vector<std::uint8_t> is_jumping = jump_triangles(surface);
  std::vector<std::uint8_t> is_outside(grid.pixels()), is_broken(grid.pixels());
  for (std::size_t i = 0; i < grid.pixels(); ++i) {
    const Index t = grid.triangle(i);
    is_outside[i] = t == no_index || !surface.boundary.is_inside[t];
    is_broken[i] = is_outside[i] || is_jumping[t];
  }
  is_inside.resize(grid.pixels());
  const std::vector<std::uint8_t> is_unsafe = widened(is_broken, width(), safe_distance_px);
  std::vector<std::uint8_t> is_measured(grid.pixels());
  for (std::size_t i = 0; i < grid.pixels(); ++i) {
    is_inside[i] = !is_outside[i];
    is_measured[i] = !is_unsafe[i];
  }
  measured = Measured(width(), std::move(is_measured));
}

void ModelPicture::draw(const Surface& surface) {
  const std::size_t n = grid.pixels();
  normals = {Plane(n), Plane(n), Plane(n)};
  depth.resize(n);
  parallel_for(n, [&](std::size_t i) {
    depth[i] = grid.at(
        i, [&](Index p) { return static_cast<float>(surface.points[p].z()); }, 0);
    Vec3f normal = Vec3f::UnitZ();
    if (is_inside[i])
      for (int axis = 0; axis < 3; ++axis)
        normal[axis] = grid.at(
            i, [&](Index p) { return surface.normals[p][axis]; }, 0);
    normal.normalize();
    normals.x[i] = normal.x(), normals.y[i] = normal.y(), normals.z[i] = normal.z();
  });
}

Plane ModelPicture::heights_in_pixels(std::span<const double> heights) const {
  Plane z(grid.pixels());
  const double scale = 1 / grid.units_per_pixel();
  parallel_for(z.size(), [&](std::size_t i) {
    z[i] = grid.at(
        i, [&](Index p) { return static_cast<float>(heights[p] * scale); }, 0);
  });
  return z;
}

NormalPicture normals_of(const Plane& z, int width) {
  NormalPicture n{Plane(z.size(), 0.F), Plane(z.size(), 0.F), Plane(z.size(), 1.F)};
  const auto w = static_cast<std::size_t>(width);
  for (std::size_t row = w; row + w < z.size(); row += w)
    for (std::size_t i = row + 1; i + 1 < row + w; ++i) {
      const float dx = (z[i + 1] - z[i - 1]) / 2, dy = (z[i - w] - z[i + w]) / 2;
      const float scale = 1 / std::sqrt(1 + dx * dx + dy * dy);
      n.x[i] = -dx * scale, n.y[i] = -dy * scale, n.z[i] = scale;
    }
  return n;
}

}  // namespace relievo
