// Links from each point to its neighbours, and the two sums over them that a frame needs.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "relievo/core/types.h"

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

  // The same, but shares the pattern of `like` if that has all these links, in this order: its others pull
  // nothing.
  PointLinks(std::span<const Index> begin, std::span<const PointLink> links, const PointLinks& like);

  // Number of points.
  std::size_t size() const { return pattern_->size; }

  // Bytes held, the pattern included unless it is that of `like`.
  std::size_t memory() const;

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
  static constexpr std::size_t window = 256;  // points

  using Others = std::array<Index, lanes>;
  using Pulls = std::array<float, 2 * lanes>;  // x and y of one lane after the other

  struct Pattern {
    std::size_t size = 0;
    std::vector<std::uint8_t> points;  // of the lanes, in their window; lanes left over repeat the last point
    std::vector<Index> begin;          // slots of slice s: others[begin[s]] up to others[begin[s + 1]]
    std::vector<Others> others;

    Index point(std::size_t place) const {
      return static_cast<Index>(place / window * window + points[place]);
    }
  };

 private:
  template <typename F>
  void for_runs(F&& f) const;

  std::shared_ptr<const Pattern> pattern_;
  std::vector<Pulls> pulls_;  // by slot
  bool owns_pattern_ = true;
};

}  // namespace relievo
