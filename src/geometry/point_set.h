// Keeps a set of points in the plane with a least distance from each other.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Points in the square cells of an unbounded grid. Queries visit neighbouring cells. Cells are hashed into
// buckets, about one per point. So a query may also visit points of distant cells in the same bucket.
class PointSet {
 public:
  explicit PointSet(double cell) : cell_(cell), first_(16, no_index) {}

  // Adds a point unless a point of the set is nearer than `distance`, which may be at most the width of a
  // cell. Returns whether the point was added.
  bool add(const Vec2& p, double distance) {
    if (distance > 0 && is_near(p, distance)) return false;
    if (points_.size() == first_.size()) double_buckets();
    points_.push_back({p, no_index});
    link(static_cast<Index>(points_.size() - 1));
    return true;
  }

  bool is_near(const Vec2& p, double distance) const {
    const std::int64_t left = cell_of(p.x() - distance), right = cell_of(p.x() + distance),
                       top = cell_of(p.y() + distance);
    for (std::int64_t y = cell_of(p.y() - distance); y <= top; ++y)
      for (std::int64_t x = left; x <= right; ++x)
        for (Index i = first_[bucket(x, y)]; i != no_index; i = points_[i].next)
          if ((p - points_[i].place).norm() < distance) return true;
    return false;
  }

 private:
  struct Member {
    Vec2 place;
    Index next;  // next point in the same bucket
  };

  std::int64_t cell_of(double v) const { return static_cast<std::int64_t>(std::floor(v / cell_)); }

  // Neighbouring cells of the same row have neighbouring buckets. The number of buckets is a power of two.
  std::size_t bucket(std::int64_t x, std::int64_t y) const {
    return (static_cast<std::uint64_t>(x) + static_cast<std::uint64_t>(y) * 0x9E3779B97F4A7C15U) &
           (first_.size() - 1);
  }

  void link(Index i) {
    const Vec2& p = points_[i].place;
    points_[i].next = std::exchange(first_[bucket(cell_of(p.x()), cell_of(p.y()))], i);
  }

  void double_buckets() {
    first_.assign(2 * first_.size(), no_index);
    for (Index i = 0; i < points_.size(); ++i) link(i);
  }

  double cell_;
  std::vector<Index> first_;  // first point of each bucket
  std::vector<Member> points_;
};

}  // namespace relievo
