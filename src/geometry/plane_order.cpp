#include "geometry/plane_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

// Returns 16 bits of a coordinate in [0, 1], with a zero between any two of them.
std::uint64_t spread(float coordinate) {
  auto x = static_cast<std::uint64_t>(std::clamp(coordinate, 0.0F, 1.0F) * 65535);
  x = (x | x << 8) & 0x00FF00FF;
  x = (x | x << 4) & 0x0F0F0F0F;
  x = (x | x << 2) & 0x33333333;
  return (x | x << 1) & 0x55555555;
}

}  // namespace

std::vector<Eigen::Vector2f> in_unit_square(std::span<const Vec2> points) {
  Eigen::AlignedBox2d box;
  for (const Vec2& p : points)
    if (p.allFinite()) box.extend(p);
  const double size = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  const double scale = size > 0 && std::isfinite(1 / size) ? 1 / size : 0;
  std::vector<Eigen::Vector2f> result(points.size(), Eigen::Vector2f::Zero());
  for (std::size_t i = 0; i < result.size(); ++i)
    if (points[i].allFinite() && scale > 0) result[i] = ((points[i] - box.min()) * scale).cast<float>();
  return result;
}

std::vector<Index> plane_order(std::span<const Eigen::Vector2f> points) {
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keys.push_back((spread(points[i].x()) | spread(points[i].y()) << 1) << 32 | i);
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order;
  order.reserve(points.size());
  for (const std::uint64_t key : keys) order.push_back(static_cast<Index>(key));
  return order;
}

}  // namespace relievo
