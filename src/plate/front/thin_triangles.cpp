#include "plate/front/thin_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "plate/plate_surface.h"

namespace relievo {
namespace {

constexpr int most_passes = 100;  // each flips one triangle of a chain of points on one line
// Height of a triangle as a share of the front's size: 8 to 16 units in the last place of its coordinates.
constexpr double thinnest = 0x1p-20;
constexpr double most_moved_mm = 1e-3;  // by flipping an edge that files could store

using EdgeEnds = std::array<Index, 2>;

class Flipper {
 public:
  explicit Flipper(Solid& front) : front_(front) {
    thinnest_mm_ = thinnest * used_box(front.points, front.triangles).longer_side();
  }

  double run() {
    std::vector<Index> all(front_.triangles.size());
    std::iota(all.begin(), all.end(), Index{0});
    std::vector<Index> thin = thin_among(all);
    for (int pass = 0; pass < most_passes && !thin.empty(); ++pass) thin = thin_among(flip_all(thin));
    return moved_mm_;
  }

 private:
  Vec2 at(Index i) const { return front_.points[i].head<2>(); }
  // Returns the place as files hold it. g++ 12 would drop the rounding of double(float(x)) without `volatile`.
  Vec2 stored(Index i) const {
    const volatile auto x = static_cast<float>(at(i).x()), y = static_cast<float>(at(i).y());
    return {static_cast<double>(x), static_cast<double>(y)};
  }

  // Returns the same triangle with its longest edge, as seen from above, between its first two corners.
  Triangle longest_first(Triangle t) const {
    const auto length_sq = [&](std::size_t i) { return (at(t[(i + 1) % 3]) - at(t[i])).squaredNorm(); };
    const std::size_t longest = std::ranges::max(std::array<std::size_t, 3>{0, 1, 2}, {}, length_sq);
    std::ranges::rotate(t, t.begin() + static_cast<std::ptrdiff_t>(longest));
    return t;
  }

  // Returns the height of the triangle over its longest edge, as seen from above.
  double width_mm(const Triangle& t) const {
    const auto [a, b, c] = longest_first(t);
    return cross(at(b) - at(a), at(c) - at(a)) / (at(b) - at(a)).norm();
  }

  // Returns those of some triangles that are thin.
  template <typename Triangles>
  std::vector<Index> thin_among(const Triangles& triangles) const {
    std::vector<Index> thin;
    for (const Index i : triangles)
      if (width_mm(front_.triangles[i]) < thinnest_mm_) thin.push_back(i);
    return thin;
  }

  // Returns the triangles to the left of those edges' other directions.
  std::map<EdgeEnds, Index> neighbours_of(const std::vector<Index>& thin) const {
    std::map<EdgeEnds, Index> neighbours;
    std::vector<std::uint8_t> is_end(front_.points.size(), 0);
    for (const Index i : thin) {
      const auto [a, b, c] = longest_first(front_.triangles[i]);
      neighbours[{b, a}] = no_index;
      is_end[a] = is_end[b] = 1;
    }
    for (Index i = 0; i < front_.triangles.size(); ++i) {
      const auto& [a, b, c] = front_.triangles[i];
      for (const EdgeEnds ends : {EdgeEnds{a, b}, EdgeEnds{b, c}, EdgeEnds{c, a}})
        if (is_end[ends[0]] && is_end[ends[1]])
          if (const auto found = neighbours.find(ends); found != neighbours.end()) found->second = i;
    }
    return neighbours;
  }

  // Flips edges, and returns the triangles that may be flipped next: those that have changed, and thin ones that wait for
  // one of them. A triangle takes part in one flip per pass.
  std::set<Index> flip_all(const std::vector<Index>& thin) {
    const std::map<EdgeEnds, Index> neighbours = neighbours_of(thin);
    std::set<Index> changed;
    for (const Index i : thin) {
      const Triangle t = longest_first(front_.triangles[i]);
      const auto found = neighbours.find({t[1], t[0]});
      if (found == neighbours.end() || found->second == no_index) continue;
      const Index neighbour = found->second;
      if (changed.contains(i) || changed.contains(neighbour) || !flip(i, t, neighbour))
        waiting_.emplace(neighbour, i);
      else
        changed.insert({i, neighbour});
    }
    std::set<Index> next = changed;
    for (const Index i : changed) {
      const auto [first, last] = waiting_.equal_range(i);
      for (auto each = first; each != last; ++each) next.insert(each->second);
      waiting_.erase(first, last);
    }
    return next;
  }

  // Replaces the edge ab of the thin triangle abc and of its neighbour by the one from c to the neighbour's opposite
  // corner, if that makes wider triangles.
  bool flip(Index thin, const Triangle& abc, Index neighbour) {
    const auto [a, b, c] = abc;
    const Triangle& other = front_.triangles[neighbour];
    const Index d = *std::ranges::find_if(other, [&](Index i) { return i != abc[0] && i != abc[1]; });
    const Triangle first{a, d, c}, second{d, b, c};
    if (std::min(width_mm(first), width_mm(second)) <= width_mm(abc)) return false;
    const double move = moved_by(abc);
    if (move > most_moved_mm && orient2d(stored(a), stored(b), stored(c)) > 0) return false;
    moved_mm_ = std::max(moved_mm_, move);
    front_.triangles[thin] = first;
    front_.triangles[neighbour] = second;
    front_.regions[thin] = front_.regions[neighbour];
    return true;
  }

  // Returns how far in z the corner c of a thin triangle is from the edge ab.
  double moved_by(const Triangle& abc) const {
    const Vec3 &a = front_.points[abc[0]], &b = front_.points[abc[1]], &c = front_.points[abc[2]];
    const Vec2 along = (b - a).head<2>();
    const double share = along.dot((c - a).head<2>()) / along.squaredNorm();
    return std::abs(c.z() - (a.z() + share * (b.z() - a.z())));
  }

  Solid& front_;
  double thinnest_mm_ = 0, moved_mm_ = 0;
  std::multimap<Index, Index> waiting_;  // thin triangles that could not be flipped, by their neighbours
};

}  // namespace

double flip_thin_triangles(Solid& front) {
  return Flipper(front).run();
}

}  // namespace relievo
