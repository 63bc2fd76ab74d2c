// Points of the plane that keep a distance from each other. Tested by tests/geometry/point_set_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Points in the square cells of a grid without bounds. Queries look into the neighbouring cells, too.
class PointSet {
 public:
  explicit PointSet(double cell) : cell_(cell) {}

  // Adds a point unless a point of the set is nearer than `distance`, which is at most the width of a cell.
  // Returns whether the point was added.
  bool add(const Vec2& p, double distance) {
    if (is_near(p, distance)) return false;
    cells_[key(cell_of(p.x()), cell_of(p.y()))].push_back(p);
    return true;
  }

  bool is_near(const Vec2& p, double distance) const {
    const std::int64_t x = cell_of(p.x()), y = cell_of(p.y());
    for (std::int64_t j = y - 1; j <= y + 1; ++j)
      for (std::int64_t i = x - 1; i <= x + 1; ++i) {
        const auto found = cells_.find(key(i, j));
        if (found == cells_.end()) continue;
        for (const Vec2& q : found->second)
          if ((p - q).norm() < distance) return true;
      }
    return false;
  }

 private:
  std::int64_t cell_of(double v) const { return static_cast<std::int64_t>(std::floor(v / cell_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(y);
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<Vec2>> cells_;
};

}  // namespace relievo
