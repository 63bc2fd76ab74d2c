// Draws depth pictures of clouds without the library, and stores the depths as other programs do. Tests use the
// pictures to check how they are read.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/depth_image.h"

namespace relievo::test {

// A camera with a figure of one metre in front of it. Its rays are parallel, or it is a pinhole camera.
struct PictureCamera {
  static constexpr double distance_m = 1.5;
  int side = 200;  // width and height of the picture in pixels
  bool is_pinhole = false;

  double metre_px() const { return side / 1.25; }
  double focal_px() const { return 1.1 * side; }  // the library assumes this length for inverse depths

  DepthCamera as_depth_camera() const { return {focal_px(), focal_px(), (side - 1) / 2., (side - 1) / 2.}; }

  // Maps a point to the picture. The point is given in metres from the figure's middle. In the result, x and y are
  // pixels from the picture's middle, and z is as in the clouds of depth_cloud().
  Vec3 map(const Vec3& p) const {
    const double depth = distance_m - p.z();
    if (!is_pinhole) return metre_px() * p;
    return {focal_px() * p.x() / depth, focal_px() * p.y() / depth, -focal_px() * std::log(depth)};
  }
  double depth_m(double z) const {
    return is_pinhole ? std::exp(-z / focal_px()) : distance_m - z / metre_px();
  }

  // Returns the normal, in the picture's coordinates, of a surface that has the normal n at the point p.
  Vec3f map_normal(const Vec3& p, const Vec3& n) const {
    if (!is_pinhole) return n.cast<float>();
    const double depth = distance_m - p.z();
    // Multiplies by the transpose of the inverse of the derivative of map(), up to a factor.
    const Vec3 turned(n.x(), n.y(), n.z() - (p.x() * n.x() + p.y() * n.y()) / depth);
    return turned.normalized().cast<float>();
  }
};

// Returns the cloud in the coordinates of the camera's picture, after scaling it so that its width or its
// height, whichever is larger, is one metre.
inline Cloud in_picture(Cloud cloud, const PictureCamera& camera) {
  const Box box = bounds(cloud);
  const double metres = 1 / std::max(box.size().x(), box.size().y());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 p = metres * (cloud.points[i] - (box.min + box.max) / 2);
    cloud.points[i] = camera.map(p);
    cloud.normals[i] = camera.map_normal(p, cloud.normals[i].cast<double>());
  }
  return cloud;
}

inline constexpr double no_figure = -std::numeric_limits<double>::infinity();

// Calls visit(pixel, height, squared distance) for the pixels near each point that faces the viewer. The height is that
// of the point's tangent plane at the pixel; the distance is that between point and pixel.
template <typename Visit>
void visit_pixels(const Cloud& cloud, int side, const Visit& visit) {
  const double middle = (side - 1) / 2.;
  constexpr double reach = 1.5, steepest = 3;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3& p = cloud.points[i];
    const Vec3 n = cloud.normals[i].cast<double>();
    if (n.z() <= 0) continue;
    const double c = p.x() + middle, r = middle - p.y(), most = steepest * n.z();
    for (int y = static_cast<int>(std::ceil(r - reach)); y <= r + reach; ++y)
      for (int x = static_cast<int>(std::ceil(c - reach)); x <= c + reach; ++x) {
        const double dx = x - c, dy = r - y, squared = dx * dx + dy * dy;
        if (squared > reach * reach || x < 0 || y < 0) continue;
        if (x >= side || y >= side) continue;
        const double rise = -std::clamp(n.x() * dx + n.y() * dy, -most, most) / n.z();
        visit(static_cast<std::size_t>(y * side + x), p.z() + rise, squared);
      }
  }
}

// Returns the heights that the picture shows. In each pixel they are a mean over the points nearest to the viewer;
// points nearer to the pixel's centre have larger weights.
inline Image<double> heights_in_picture(const Cloud& cloud, int side) {
  constexpr double thickness_px = 1.5, spread_px = .4;
  Image<double> nearest = filled_image(side, side, no_figure);
  visit_pixels(cloud, side, [&](std::size_t i, double z, double) { nearest[i] = std::max(nearest[i], z); });
  Image<double> sum = filled_image(nearest.width, nearest.height, 0.), weight = sum;
  visit_pixels(cloud, side, [&](std::size_t i, double z, double squared) {
    const double near = std::exp(-squared / (2 * spread_px * spread_px));
    if (z > nearest[i] - thickness_px) sum[i] += near * z, weight[i] += near;
  });
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = weight[i] > 0 ? sum[i] / weight[i] : no_figure;
  return sum;
}

// A way to store depths, which are given in metres.
struct DepthStorage {
  std::string name;
  DepthValues kind = DepthValues::depth;
  double step = 0;                      // step between stored values: 1 for integers, 0 for fractions
  std::function<double(double)> value;  // returns the stored value of a depth
  bool is_pinhole = false;              // if so, metric depths come with the focal length
};

// The values of the pixels beside the figure, in a depth picture.
struct BesideFigure {
  double wall_m = 0;  // distance of a slightly tilted wall behind the figure; 0 for none
  float missing = 0;  // the value of pixels without a depth
};

inline DepthImage depth_picture(const Image<double>& heights, const DepthStorage& how,
                                const BesideFigure& beside) {
  const PictureCamera camera{heights.width, how.is_pinhole};
  DepthImage image{{heights.width, heights.height, 1, {}}, how.step, "test"};
  for (int r = 0; r < heights.height; ++r)
    for (int c = 0; c < heights.width; ++c) {
      const double z = heights.at(c, r), wall = camera.distance_m + beside.wall_m + 1e-4 * (c + r);
      const bool is_missing = z == no_figure && beside.wall_m == 0;
      const double depth = z == no_figure ? wall : camera.depth_m(z);
      image.values.pixels.push_back(is_missing ? beside.missing : static_cast<float>(how.value(depth)));
    }
  return image;
}

using Mask = Image<std::uint8_t>;

// Returns the largest distance from a pixel in `from` to the nearest pixel in `to`, along rows or columns; at most 9.
inline int farthest_px(const Mask& from, const Mask& to) {
  int most = 0;
  const auto is_near = [&](int column, int row) {
    for (int y = row - most; y <= row + most; ++y)
      for (int x = column - most; x <= column + most; ++x)
        if (to.contains(x, y) && to.at(x, y)) return true;
    return false;
  };
  for (int r = 0; r < from.height; ++r)
    for (int c = 0; c < from.width; ++c)
      while (from.at(c, r) && most < 9 && !is_near(c, r)) ++most;
  return most;
}

// Returns the number of connected parts that have less than 0.5 % of the mask's pixels.
inline int count_crumbs(Mask mask) {
  const auto all = static_cast<std::size_t>(std::ranges::count(mask.pixels, 1));
  int crumbs = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) continue;
    std::vector<std::size_t> part{i};
    mask[i] = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const int c = static_cast<int>(part[k]) % mask.width, r = static_cast<int>(part[k]) / mask.width;
      for (int y = r - 1; y <= r + 1; ++y)
        for (int x = c - 1; x <= c + 1; ++x)
          if (mask.contains(x, y) && mask.at(x, y)) mask.at(x, y) = 0, part.push_back(mask.index(x, y));
    }
    crumbs += 200 * part.size() < all;
  }
  return crumbs;
}

}  // namespace relievo::test
