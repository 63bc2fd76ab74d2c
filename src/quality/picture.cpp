#include "quality/picture.h"

#include <algorithm>
#include <cmath>

#include "geometry/raster.h"
#include "relievo/core/parallel.h"

namespace relievo {

PictureGrid::PictureGrid(std::span<const Vec3> points, const Triangulation& triangulation, int longer_side_px,
                         int margin_px) {
  const Box box = Box::of(points);
  const Vec3 size = box.size();
  units_per_pixel_ = box.longer_side() / longer_side_px;
  if (!(units_per_pixel_ > 0)) return;
  const auto pixels = [&](double length) {
    return std::max(1, static_cast<int>(std::ceil(length / units_per_pixel_ - 1e-9))) + 2 * margin_px;
  };
  width_ = pixels(size.x());
  height_ = pixels(size.y());
  places_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));

  RasterInput scene{std::vector<Vec3>(points.size()), triangulation.triangles, width_, height_};
  centre_ = box.centre();
  parallel_for(points.size(), [&](std::size_t i) {
    const Vec2 place = to_pixels(points[i]);
    scene.points[i] = {place.x(), place.y(), 0};
  });
  const Rasterizer raster(scene, 16);
  parallel_for(
      raster.bands(),
      [&](std::size_t b) {
        const RowBand band = raster.draw(b);
        for (std::size_t s = 0; s < band.fragments.size(); ++s) {
          const Index t = band.fragments[s].triangle;
          const int column = static_cast<int>(s) % width_,
                    row = band.first_row + static_cast<int>(s) / width_;
          if (t != no_index)
            places_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(column)] = {t, triangulation.triangles[t],
                                                         corner_weights(scene, t, column + .5, row + .5)};
        }
      },
      1);
}

GaussianFilter::GaussianFilter(double sigma, int reach) : weights_(static_cast<std::size_t>(reach) + 1) {
  double sum = 0;
  for (int d = -reach; d <= reach; ++d) sum += std::exp(-d * d / (2 * sigma * sigma));
  for (int d = 0; d <= reach; ++d)
    weights_[static_cast<std::size_t>(d)] = static_cast<float>(std::exp(-d * d / (2 * sigma * sigma)) / sum);
}

void GaussianFilter::apply(Plane& plane, int width) const {
  const int height = static_cast<int>(plane.size()) / width, reach = static_cast<int>(weights_.size()) - 1;
  const auto row_of = [&](Plane& p, int row) {
    return p.data() + std::clamp(row, 0, height - 1) * std::ptrdiff_t{width};
  };
  Plane down(plane.size());
  for (int row = 0; row < height; ++row) {
    float* const to = row_of(down, row);
    for (int x = 0; x < width; ++x) to[x] = weights_[0] * row_of(plane, row)[x];
    for (int d = 1; d <= reach; ++d) {
      const float *const above = row_of(plane, row - d), *const below = row_of(plane, row + d);
      for (int x = 0; x < width; ++x) to[x] += weights_[static_cast<std::size_t>(d)] * (above[x] + below[x]);
    }
  }
  Plane line(static_cast<std::size_t>(width + 2 * reach));
  for (int row = 0; row < height; ++row) {
    const float* const from = row_of(down, row);
    for (int x = -reach; x < width + reach; ++x) line[x + reach] = from[std::clamp(x, 0, width - 1)];
    float* const to = row_of(plane, row);
    const float* const middle = line.data() + reach;
    for (int x = 0; x < width; ++x) to[x] = weights_[0] * middle[x];
    for (int d = 1; d <= reach; ++d)
      for (int x = 0; x < width; ++x)
        to[x] += weights_[static_cast<std::size_t>(d)] * (middle[x - d] + middle[x + d]);
  }
}

std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& mask, int width, int reach) {
  const int height = static_cast<int>(mask.size()) / width;
  std::vector<std::uint8_t> across(mask.size()), out(mask.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int other = std::max(0, x - reach); other <= std::min(width - 1, x + reach); ++other)
        across[y * width + x] |= mask[y * width + other];
  for (int y = 0; y < height; ++y)
    for (int other = std::max(0, y - reach); other <= std::min(height - 1, y + reach); ++other)
      for (int x = 0; x < width; ++x) out[y * width + x] |= across[other * width + x];
  return out;
}

}  // namespace relievo
