#include "quality/model_picture.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {

namespace {

// Returns for each triangle whether it has a point of a depth jump. The walls at jumps alone would not do:
// they are narrower than a pixel.
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

}  // namespace relievo
