#include "geometry/space_curve.h"

#include <algorithm>
#include <tuple>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns the 21 low bits of v with two zeros after each.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x1F00000000FFFF;
  v = (v | v << 16) & 0x1F0000FF0000FF;
  v = (v | v << 8) & 0x100F00F00F00F00F;
  v = (v | v << 4) & 0x10C30C30C30C30C3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

}  // namespace

std::vector<Index> space_curve_order(std::span<const Vec3> points) {
  const Box box = Box::of(points);
  const double cells = (1 << 21) - 1;
  const double scale = cells / std::max(box.size().maxCoeff(), 1e-300);
  struct Key {
    std::uint64_t code;
    Index point;
  };
  std::vector<Key> keys(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    const Vec3 cell = scale * (points[i] - box.min);
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) code |= spread(static_cast<std::uint64_t>(cell[axis])) << axis;
    keys[i] = {code, static_cast<Index>(i)};
  });
  const auto coordinates = [&](Index i) {
    return std::tuple(points[i].x(), points[i].y(), points[i].z(), i);
  };
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    return a.code != b.code ? a.code < b.code : coordinates(a.point) < coordinates(b.point);
  });
  std::vector<Index> order(points.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Key& key) { return key.point; });
  return order;
}

}  // namespace relievo
