// Links from each point to its neighbours, and the two sums over them that a frame needs.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/types.h"

namespace relievo {

struct PointLink {
  Index other = 0;
  Vec2f pull = Vec2f::Zero();
};

// Kept in slices of eight points, as vectors read them: the first link of all eight, then the second. Points
// of equal counts share a slice, within windows of 256 points, so that little is filled up (SELL-C-sigma;
// Kreutzer, Hager, Wellein, Fehske and Bishop, 2014). Sums run in the order of the links given.
class PointLinks {
 public:
  // Copies the links of point i, which are links[begin[i]] up to links[begin[i + 1]].
  PointLinks(std::span<const Index> begin, std::span<const PointLink> links);

  // Number of points.
  std::size_t size() const { return size_; }

  std::size_t memory() const {
    return slots_.size() * sizeof(Slot) + (begin_.size() + points_.size()) * sizeof(Index);
  }

  // sums[i] = sum of (slopes[i] + slopes[other]) . pull: the right-hand side of equation (9).
  void divergence(std::span<const Vec2f> slopes, std::span<float> sums) const;
  void divergence(std::span<const Vec2> slopes, std::span<double> sums) const;

  // Normals along (x, y, 1), where (x, y) = sum of heights[other] pull, and their cosines to `light`, a unit
  // vector, 0 where turned away.
  struct Shaded {
    std::span<Vec3f> normals;
    std::span<float> shading;
  };
  void normals(std::span<const float> heights, const Vec3f& light, const Shaded& out) const;

  static constexpr std::size_t lanes = 8;

  struct Slot {
    std::array<Index, lanes> other;
    std::array<float, 2 * lanes> pull;  // x and y of one lane after the other
  };

 private:
  template <typename F>
  void for_runs(F&& f) const;

  std::size_t size_ = 0;
  std::vector<Index> points_;  // in the order of the lanes; lanes left over repeat the last point
  std::vector<Index> begin_;   // slots of slice s: slots_[begin_[s]] up to slots_[begin_[s + 1]]
  std::vector<Slot> slots_;
};

}  // namespace relievo
