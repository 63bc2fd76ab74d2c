#include "quality/model_picture.h"

#include <algorithm>
#include <cmath>

#include "geometry/raster.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {

namespace {

// Returns for each triangle whether one of its corners is at a depth jump. The triangles across jumps would not
// suffice: they form walls narrower than a pixel, which are not drawn.
std::vector<std::uint8_t> around_jumps(const Surface& surface) {
  const std::vector<Triangle>& triangles = surface.triangulation.triangles;
  std::vector<std::uint8_t> is_around = jump_triangles(surface), is_at_jump(surface.points.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (is_around[t])
      for (const Index p : triangles[t]) is_at_jump[p] = 1;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    is_around[t] = std::ranges::any_of(triangles[t], [&](Index p) { return is_at_jump[p] != 0; });
  return is_around;
}

}  // namespace

ModelPicture::ModelPicture(const Surface& surface, int longer_side_px, int margin_px)
    : grid(surface.points, surface.triangulation, longer_side_px, margin_px) {
  if (grid.pixels() == 0) return;
  classify(surface);
  draw(surface);
}

void ModelPicture::classify(const Surface& surface) {
  const std::vector<std::uint8_t> is_jumping = around_jumps(surface);
  Image8 is_outside = filled_image(grid.width(), grid.height(), std::uint8_t{0}), is_broken = is_outside;
  for (std::size_t i = 0; i < grid.pixels(); ++i) {
    const Index t = grid.triangle(i);
    is_outside[i] = t == no_index || !surface.boundary.is_inside[t];
    is_broken[i] = is_outside[i] || is_jumping[t];
  }
  is_inside.resize(grid.pixels());
  const Image8 is_unsafe = dilated(is_broken, safe_distance_px);
  Image8 is_measured = is_unsafe;
  for (std::size_t i = 0; i < grid.pixels(); ++i) {
    is_inside[i] = !is_outside[i];
    is_measured[i] = !is_unsafe[i];
  }
  measured = PixelMask(std::move(is_measured));
}

void ModelPicture::draw(const Surface& surface) {
  depth = filled_image(grid.width(), grid.height(), 0.F);
  normals = {depth, depth, depth};
  parallel_for(depth.size(), [&](std::size_t i) {
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

Image<float> ModelPicture::heights_in_pixels(std::span<const double> heights) const {
  Image<float> z = filled_image(grid.width(), grid.height(), 0.F);
  const double scale = 1 / grid.units_per_pixel();
  parallel_for(z.size(), [&](std::size_t i) {
    z[i] = grid.at(
        i, [&](Index p) { return static_cast<float>(heights[p] * scale); }, 0);
  });
  return z;
}

NormalMap normals_of(const Image<float>& z) {
  const Image<float> level = filled_image(z.width, z.height, 0.F);
  NormalMap n{level, level, filled_image(z.width, z.height, 1.F)};
  const auto w = static_cast<std::size_t>(z.width);
  for (std::size_t row = w; row + w < z.size(); row += w)
    for (std::size_t i = row + 1; i + 1 < row + w; ++i) {
      const float dx = (z[i + 1] - z[i - 1]) / 2, dy = (z[i - w] - z[i + w]) / 2;
      const float scale = 1 / std::sqrt(1 + dx * dx + dy * dy);
      n.x[i] = -dx * scale, n.y[i] = -dy * scale, n.z[i] = scale;
    }
  return n;
}

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
