#include "plate/front/thin_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/groups.h"
#include "core/lists.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/weld.h"
#include "plate/coincident_points.h"
#include "plate/plate_surface.h"
#include "relievo/core/types.h"

namespace relievo {
namespace {

// Lists the triangles around each point of a mesh. Small parts of the mesh may change.
class Fans {
 public:
  // Keeps a reference to the triangles, so their address must not change.
  Fans(std::size_t points, std::span<const Triangle> triangles)
      : triangles_(triangles), first_(grouped<Index>(points, [&](auto&& add) {
          for (Index t = 0; t < triangles.size(); ++t)
            for (const Index i : triangles[t]) add(i, t);
        })) {}

  // Returns the triangles around a point; the span is valid until the mesh is changed.
  std::span<const Index> around(Index point) const {
    const auto found = changed_.find(point);
    return found == changed_.end() ? first_[point] : std::span<const Index>(found->second);
  }

  // Returns the triangle to the left of the edge; no_index if there is none.
  Index left_of(Index from, Index to) const {
    for (const Index t : around(from)) {
      const auto& [a, b, c] = triangles_[t];
      if ((a == from && b == to) || (b == from && c == to) || (c == from && a == to)) return t;
    }
    return no_index;
  }

  void add(Index point, Index triangle) { changing(point).push_back(triangle); }
  void remove(Index point, Index triangle) { std::erase(changing(point), triangle); }

 private:
  std::vector<Index>& changing(Index point) {
    const auto [found, is_new] = changed_.try_emplace(point);
    if (is_new) found->second.assign(first_[point].begin(), first_[point].end());
    return found->second;
  }

  std::span<const Triangle> triangles_;
  Groups<Index> first_;
  std::unordered_map<Index, std::vector<Index>> changed_;
};

// Least height of a triangle, as a share of the front's size. This share of the size is 8 to 16 units in
// the last place of the coordinates.
constexpr double thinnest = 0x1p-20;
// A flip may move the surface by at most this distance in z. The limit does not apply if rounding the coordinates turns
// the thin triangle over.
constexpr double most_moved_mm = 1e-3;

// Flips edges one by one. Each flip makes the thinner of two triangles wider, so the loop ends.
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
  // Returns the x and y of a point as files store them. Without `volatile` g++ 12 would remove the rounding
  // in double(float(x)).
  Vec2 stored(Index i) const {
    const volatile auto x = static_cast<float>(at(i).x()), y = static_cast<float>(at(i).y());
    return {static_cast<double>(x), static_cast<double>(y)};
  }

  // Rotates the corners of t so that the longest edge, seen from above, is between the first two.
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

  // Flips the longest edge of a thin triangle. If that edge is on the front's boundary, removes the triangle instead.
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

  // Appends the thin neighbours of a changed triangle to the queue.
  void wake_around(Index changed) {
    const Triangle& t = front_.triangles[changed];
    for (std::size_t i = 0; i < 3; ++i)
      if (const Index beside = fans_->left_of(t[(i + 1) % 3], t[i]); beside != no_index && is_thin(beside))
        waiting_.push_back(beside);
  }

  // Returns the triangles around `corner` in order. Starts with the triangle on the given side of the edge
  // from `corner` to `other`. Ends at the boundary of the front or after a full turn.
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

  // Returns whether removing the triangle abc would leave two parts that are connected only by the corner c.
  // The edge ab must be on the front's boundary. Returns false if all triangles on one side of c are thin,
  // because these are removed next.
  bool would_pinch(const Triangle& abc) const {
    const auto [a, b, c] = abc;
    const auto are_thin = [&](const std::vector<Index>& side) {
      return std::ranges::all_of(side, [&](Index t) { return is_thin(t); });
    };
    const std::vector<Index> before = side_of(c, a, false), after = side_of(c, b, true);
    const bool is_inside = before.size() == fans_->around(c).size();  // whether triangles surround c
    return !is_inside && !are_thin(before) && !are_thin(after);
  }

  void remove(Index thin, const Triangle& abc) {
    if (!may_lose_edges_ || would_pinch(abc)) return;
    is_removed_[thin] = 1;
    for (const Index i : abc) fans_->remove(i, thin);
    wake_around(thin);
  }

  // Replaces the edge ab between the thin triangle abc and its neighbour by the edge from c to the opposite
  // corner of the neighbour. Does nothing if the thinner of both triangles would not become wider.
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

  // Returns how far the flip of a thin triangle abc changes the surface: the distance in z from the
  // corner c to the edge ab.
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

constexpr int most_steps = 6;  // units in the last place by which a point may move
constexpr int most_passes = 8;

// Returns the x and y of all points, rounded as in files.
std::vector<Vec2> stored_places(const Solid& solid) {
  std::vector<Vec2> places;
  places.reserve(solid.points.size());
  for (const Vec3f& p : stored_points(solid)) places.push_back(p.head<2>().cast<double>());
  return places;
}

bool is_folded(std::span<const Vec2> places, const Triangle& t) {
  return orient2d(places[t[0]], places[t[1]], places[t[2]]) <= 0;
}

std::span<const Triangle> front_of(const Solid& solid) {
  return std::span(solid.triangles).first(solid.front_triangles);
}

std::vector<Index> folds_among(const Solid& solid, std::span<const Vec2> places) {
  return indices_where(solid.front_triangles, [&](Index t) { return is_folded(places, solid.triangles[t]); });
}

class Unfolder {
 public:
  Unfolder(Solid& solid, std::span<const Index> outline)
      : solid_(solid), places_(stored_places(solid)), is_fixed_(solid.points.size(), 0) {
    for (const Index i : outline) is_fixed_[i] = 1;
  }

  void run() {
    std::vector<Index> folds = folds_among(solid_, places_);
    if (folds.empty()) return;
    prepare();
    for (int pass = 0; pass < most_passes && !folds.empty(); ++pass) {
      for (const Index t : folds)
        if (is_folded(places_, solid_.triangles[t])) mend(solid_.triangles[t]);
      folds = folds_among(solid_, places_);
    }
  }

 private:
  void prepare() {
    fans_.emplace(solid_.points.size(), front_of(solid_));
    const Box box = used_box(solid_.points, solid_.triangles);
    for (std::size_t i = 0; i < is_fixed_.size(); ++i) {
      const Vec3& p = solid_.points[i];
      is_fixed_[i] |= ((p - box.min).head<2>().minCoeff() <= 0 || (box.max - p).head<2>().minCoeff() <= 0);
    }
    const auto largest = static_cast<float>(
        std::max(box.max.head<2>().cwiseAbs().maxCoeff(), box.min.head<2>().cwiseAbs().maxCoeff()));
    step_ = static_cast<double>(std::nextafter(largest, 2 * largest) - largest);
    const bool has_walls = solid_.front_triangles < solid_.triangles.size();
    for (Index i = 0; has_walls && i < solid_.points.size(); ++i)
      at_place_.emplace(std::pair(solid_.points[i].x(), solid_.points[i].y()), i);
  }

  std::size_t folds_around(Index point) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        fans_->around(point), [&](Index t) { return is_folded(places_, solid_.triangles[t]); }));
  }

  // Tries to move one corner of a folded triangle so that fewer triangles around this corner are folded.
  void mend(const Triangle& t) {
    for (int steps = 1; steps <= most_steps; ++steps)
      for (const Index corner : t)
        for (const Vec2& direction : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1), Vec2(1, 1),
                                      Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)})
          if (!is_fixed_[corner] && improves(corner, steps * step_ * direction)) return;
  }

  bool improves(Index corner, const Vec2& move) {
    const std::size_t before = folds_around(corner);
    const Vec2f place = (places_[corner] + move).cast<float>();
    const Vec2 old = std::exchange(places_[corner], place.cast<double>());
    if (folds_around(corner) < before) {
      move_all_at(corner, places_[corner]);
      return true;
    }
    places_[corner] = old;
    return false;
  }

  // Moves the point together with the points below it, which have the same x and y.
  void move_all_at(Index corner, const Vec2& place) {
    std::vector<Index> together{corner};
    const auto [first, last] =
        at_place_.equal_range(std::pair(solid_.points[corner].x(), solid_.points[corner].y()));
    for (auto each = first; each != last; ++each) together.push_back(each->second);
    at_place_.erase(first, last);
    for (const Index i : together) {
      solid_.points[i].head<2>() = places_[i] = place;
      at_place_.emplace(std::pair(place.x(), place.y()), i);
    }
  }

  Solid& solid_;
  std::vector<Vec2> places_;
  std::vector<std::uint8_t> is_fixed_;
  std::optional<Fans> fans_;
  // Points by x and y; empty before walls are added.
  std::multimap<std::pair<double, double>, Index> at_place_;
  double step_ = 0;
};

}  // namespace

double flip_thin_triangles(Solid& front, bool may_lose_edges) {
  return Flipper(front, may_lose_edges).run();
}

std::vector<Index> find_folds(const Solid& solid) {
  return folds_among(solid, stored_places(solid));
}

void unfold(Solid& solid, std::span<const Index> outline) {
  Unfolder(solid, outline).run();
}

}  // namespace relievo
