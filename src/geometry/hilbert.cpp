#include "geometry/hilbert.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr unsigned bits = 12;  // bits of a cell's number per axis; cells with many points are divided again

// An entry has the position along the curve in its upper 32 bits, and the index of the point in the lower 32
// bits.
using Entry = std::uint64_t;
using Entries = std::span<Entry>;

constexpr Index number(Entry e) {
  return static_cast<Index>(e);
}
constexpr std::uint32_t place(Entry e) {
  return static_cast<std::uint32_t>(e >> 32);
}

// Returns the position of the cell (x, y) along a Hilbert curve through 2^bits x 2^bits cells. At each level
// the curve visits four quadrants; the first and the last are mirrored at a diagonal.
std::uint32_t place_of_cell(std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0;
  for (unsigned level = bits; level-- > 0;) {
    const std::uint32_t right = x >> level & 1, top = y >> level & 1;
    place = place << 2 | ((3 * right) ^ top);
    if (top == 0) {
      const std::uint32_t flip = right == 0 ? 0 : ~0U;
      const std::uint32_t old_x = x;
      x = y ^ flip;
      y = old_x ^ flip;
    }
  }
  return place;
}

// Sorts the entries along a Hilbert curve through their bounding square. Returns false if all points
// coincide.
bool sort_along_curve(std::span<const Vec2> points, Entries entries) {
  Vec2 low = points[number(entries.front())], high = low;
  for (const Entry e : entries) {
    low = low.cwiseMin(points[number(e)]);
    high = high.cwiseMax(points[number(e)]);
  }
  const double extent = (high - low).maxCoeff();
  if (extent == 0) return false;
  const double scale = ((1U << bits) - 1) / extent;
  for (Entry& e : entries) {
    const Vec2 cell = (points[number(e)] - low) * scale;
    const auto x = static_cast<std::uint32_t>(cell.x()), y = static_cast<std::uint32_t>(cell.y());
    e = Entry{place_of_cell(x, y)} << 32 | number(e);
  }
  std::sort(entries.begin(), entries.end());
  return true;
}

// Returns the upper 16 bits of a coordinate in [0, 1], each followed by a zero bit.
std::uint64_t spread(float coordinate) {
  auto x = static_cast<std::uint64_t>(std::clamp(coordinate, 0.0F, 1.0F) * 65535);
  x = (x | x << 8) & 0x00FF00FF;
  x = (x | x << 4) & 0x0F0F0F0F;
  x = (x | x << 2) & 0x33333333;
  return (x | x << 1) & 0x55555555;
}

// Returns the 21 low bits of v, each followed by two zero bits.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x1F00000000FFFF;
  v = (v | v << 16) & 0x1F0000FF0000FF;
  v = (v | v << 8) & 0x100F00F00F00F00F;
  v = (v | v << 4) & 0x10C30C30C30C30C3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

}  // namespace

std::vector<Index> hilbert_order(std::span<const Vec2> points) {
  std::vector<Entry> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) entries[i] = i;

  // If a cell has more points than this, these points are sorted along a finer curve in the cell, and so on.
  // A stack replaces recursion, which nested clusters could make deep.
  constexpr std::ptrdiff_t most_in_a_cell = 8;
  std::vector<Entries> todo;
  if (!entries.empty()) todo.emplace_back(entries);
  while (!todo.empty()) {
    const Entries part = todo.back();
    todo.pop_back();
    if (!sort_along_curve(points, part)) continue;
    for (auto begin = part.begin(); begin != part.end();) {
      const auto end = std::find_if(begin, part.end(), [&](Entry e) { return place(e) != place(*begin); });
      if (end - begin > most_in_a_cell) todo.emplace_back(begin, end);
      begin = end;
    }
  }

  std::vector<Index> order(points.size());
  std::transform(entries.begin(), entries.end(), order.begin(), number);
  return order;
}

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
