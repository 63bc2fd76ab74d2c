#include "plate/front/thin_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "core/keep_where.h"
#include "geometry/compact.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "plate/front/fans.h"
#include "plate/plate_surface.h"

namespace relievo {
namespace {

// Height of a triangle as a share of the front's size: 8 to 16 units in the last place of its coordinates.
constexpr double thinnest = 0x1p-20;
constexpr double most_moved_mm = 1e-3;  // limit of moves by flips, for triangles that files store unfolded

// Flips one edge after another. Each flip makes the thinner of two triangles wider, so that the flipping
// ends.
class Flipper {
 public:
  Flipper(Solid& front, bool may_lose_edges) : front_(front), may_lose_edges_(may_lose_edges) {
    thinnest_mm_ = thinnest * used_box(front.points, front.triangles).longer_side();
  }

  double run() {
    for (Index t = 0; t < front_.triangles.size(); ++t)
      if (is_thin(t)) waiting_.push_back(t);
    if (waiting_.empty()) return 0;
    fans_.emplace(front_.points.size(), front_.triangles);
    is_removed_.assign(front_.triangles.size(), 0);
    for (; !waiting_.empty(); waiting_.pop_front())
      if (const Index t = waiting_.front(); !is_removed_[t] && is_thin(t)) widen(t);
    drop_removed();
    return moved_mm_;
  }

 private:
  Vec2 at(Index i) const { return front_.points[i].head<2>(); }
  // Returns the x and y of a point as files store them. Without `volatile`, g++ 12 would drop the rounding of
  // double(float(x)).
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

  bool is_thin(Index t) const { return width_mm(front_.triangles[t]) < thinnest_mm_; }

  // Flips the longest edge of a thin triangle, or removes the triangle if that edge is on the front's
  // boundary.
  void widen(Index thin) {
    const Triangle abc = longest_first(front_.triangles[thin]);
    const Index other = fans_->left_of(abc[1], abc[0]);
    if (other == no_index)
      remove(thin, abc);
    else if (flip(thin, abc, other))
      for (const Index changed : {thin, other}) {
        waiting_.push_back(changed);
        wake_around(changed);
      }
  }

  // Puts thin triangles beside a changed one into the queue again.
  void wake_around(Index changed) {
    const Triangle& t = front_.triangles[changed];
    for (std::size_t i = 0; i < 3; ++i)
      if (const Index beside = fans_->left_of(t[(i + 1) % 3], t[i]); beside != no_index && is_thin(beside))
        waiting_.push_back(beside);
  }

  // Returns the triangles around a corner in their order, from the triangle on the given side of the edge
  // between corner and `other`, to the boundary of the front or once around.
  std::vector<Index> side_of(Index corner, Index other, bool is_left) const {
    std::vector<Index> side;
    for (Index end = other; side.size() < fans_->around(corner).size();) {
      const Index t = is_left ? fans_->left_of(corner, end) : fans_->left_of(end, corner);
      if (t == no_index) return side;
      side.push_back(t);
      end = *std::ranges::find_if(front_.triangles[t], [&](Index i) { return i != corner && i != end; });
    }
    return side;
  }

  // Returns whether removing the triangle abc, whose edge ab is on the front's boundary, would leave two
  // parts that are connected by the corner c alone. The result is false if all triangles on one side of c are
  // thin, because these are removed next.
  bool would_pinch(const Triangle& abc) const {
    const auto [a, b, c] = abc;
    const auto are_thin = [&](const std::vector<Index>& side) {
      return std::ranges::all_of(side, [&](Index t) { return is_thin(t); });
    };
    const std::vector<Index> before = side_of(c, a, false), after = side_of(c, b, true);
    const bool is_inside = before.size() == fans_->around(c).size();  // they go all around c, up to abc
    return !is_inside && !are_thin(before) && !are_thin(after);
  }

  void remove(Index thin, const Triangle& abc) {
    if (!may_lose_edges_ || would_pinch(abc)) return;
    is_removed_[thin] = 1;
    for (const Index i : abc) fans_->remove(i, thin);
    wake_around(thin);
  }

  // Replaces the edge ab between the thin triangle abc and its neighbour by the edge from c to the
  // neighbour's opposite corner, if that makes the triangles wider.
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
    fans_->remove(b, thin), fans_->add(d, thin);
    fans_->remove(a, neighbour), fans_->add(c, neighbour);
    return true;
  }

  // Returns the distance in z of the corner c of a thin triangle from the edge ab.
  double moved_by(const Triangle& abc) const {
    const Vec3 &a = front_.points[abc[0]], &b = front_.points[abc[1]], &c = front_.points[abc[2]];
    const Vec2 along = (b - a).head<2>();
    const double share = along.dot((c - a).head<2>()) / along.squaredNorm();
    return std::abs(c.z() - (a.z() + share * (b.z() - a.z())));
  }

  void drop_removed() {
    if (std::ranges::count(is_removed_, 0) == std::ssize(is_removed_)) return;
    const auto is_left = [&](std::size_t t) { return !is_removed_[t]; };
    keep_where(front_.triangles, is_left);
    keep_where(front_.regions, is_left);
    drop_unused(front_);
  }

  Solid& front_;
  bool may_lose_edges_;
  double thinnest_mm_ = 0, moved_mm_ = 0;
  std::deque<Index> waiting_;  // triangles that may be thin
  std::optional<Fans> fans_;
  std::vector<std::uint8_t> is_removed_;
};

}  // namespace

double flip_thin_triangles(Solid& front, bool may_lose_edges) {
  return Flipper(front, may_lose_edges).run();
}

}  // namespace relievo
