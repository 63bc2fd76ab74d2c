#include "geometry/held_edges.h"

#include <algorithm>
#include <deque>
#include <unordered_set>

#include "geometry/predicates.h"

namespace relievo {
namespace {

// The side of a triangle opposite to its corner `apex`.
struct EdgeOfTriangle {
  Index triangle = no_index;
  std::size_t apex = 0;
};

class EdgeHolder {
 public:
  EdgeHolder(std::span<const Vec2> points, Triangulation& mesh)
      : points_(points), mesh_(mesh), at_(points.size(), no_index) {
    for (Index t = 0; t < mesh.triangles.size(); ++t)
      for (const Index i : mesh.triangles[t]) at_[i] = t;
  }

  bool hold(Index a, Index b) {
    if (a == b || at_[a] == no_index || at_[b] == no_index) return false;
    if (find(a, b).triangle == no_index && !flip_until(a, b)) return false;
    held_.insert(key(a, b));
    return true;
  }

 private:
  static std::uint64_t key(Index a, Index b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
  }

  Index corner(const EdgeOfTriangle& side, std::size_t after) const {
    return mesh_.triangles[side.triangle][(side.apex + after) % 3];
  }

  std::size_t place_of(Index t, Index point) const {
    const Triangle& corners = mesh_.triangles[t];
    return static_cast<std::size_t>(std::ranges::find(corners, point) - corners.begin());
  }

  // Calls visit(side) for the side opposite to `point` in each triangle around `point`, until visit() returns
  // true. Returns the side for which visit() returned true. If there is none, the result's triangle is
  // no_index.
  template <typename Visit>
  EdgeOfTriangle around(Index point, Visit&& visit) const {
    for (const std::size_t turn : {std::size_t{1}, std::size_t{2}}) {
      Index t = at_[point];
      do {
        const EdgeOfTriangle side{t, place_of(t, point)};
        if (visit(side)) return side;
        t = mesh_.neighbours[t][(side.apex + turn) % 3];
      } while (t != no_index && t != at_[point]);
      if (t != no_index) break;
    }
    return {};
  }

  // Returns the side with the ends a and b; its triangle is no_index if there is no such side.
  EdgeOfTriangle find(Index a, Index b) const {
    const EdgeOfTriangle side =
        around(a, [&](const EdgeOfTriangle& s) { return corner(s, 1) == b || corner(s, 2) == b; });
    if (side.triangle == no_index) return side;
    return {side.triangle, (side.apex + (corner(side, 1) == b ? 2 : 1)) % 3};
  }

  int turn(Index a, Index b, Index c) const { return orient2d(points_[a], points_[b], points_[c]); }

  bool is_crossing(Index a, Index b, Index u, Index v) const {
    return turn(a, b, u) * turn(a, b, v) < 0 && turn(u, v, a) * turn(u, v, b) < 0;
  }

  // Collects the edges that the segment from a to b crosses. Returns false if the segment passes through
  // another point, or crosses an edge that must be kept.
  bool collect(Index a, Index b, std::deque<EdgeEnds>& crossed) const {
    EdgeOfTriangle side =
        around(a, [&](const EdgeOfTriangle& s) { return is_crossing(a, b, corner(s, 1), corner(s, 2)); });
    while (side.triangle != no_index) {
      const Index u = corner(side, 1), v = corner(side, 2);
      if (held_.contains(key(u, v))) return false;
      crossed.push_back({u, v});
      const Index across = mesh_.neighbours[side.triangle][side.apex];
      if (across == no_index) return false;
      const Triangle& corners = mesh_.triangles[across];
      const Index facing = *std::ranges::find_if(corners, [&](Index i) { return i != u && i != v; });
      if (facing == b) return true;
      const int where = turn(a, b, facing);
      if (where == 0) return false;
      side = {across, place_of(across, where == turn(a, b, u) ? u : v)};
    }
    return false;
  }

  void replace_neighbour(Index t, Index old, Index by) {
    if (t != no_index) *std::ranges::find(mesh_.neighbours[t], old) = by;
  }

  // Replaces `side`, an edge between two triangles, by the other diagonal of the quadrilateral that the two
  // triangles form.
  void flip(const EdgeOfTriangle& side) {
    const Index t = side.triangle, s = mesh_.neighbours[t][side.apex];
    const Index p = corner(side, 0), u = corner(side, 1), v = corner(side, 2);
    const std::size_t in_s = place_of(s, u);
    const Index q = mesh_.triangles[s][(in_s + 1) % 3];
    const Index beside_u = mesh_.neighbours[t][(side.apex + 2) % 3],
                beside_v = mesh_.neighbours[t][(side.apex + 1) % 3];
    const Index across_u = mesh_.neighbours[s][place_of(s, v)], across_v = mesh_.neighbours[s][in_s];
    mesh_.triangles[t] = {p, u, q}, mesh_.neighbours[t] = {across_u, s, beside_u};
    mesh_.triangles[s] = {p, q, v}, mesh_.neighbours[s] = {across_v, beside_v, t};
    replace_neighbour(across_u, s, t), replace_neighbour(beside_v, t, s);
    at_[p] = at_[u] = at_[q] = t, at_[v] = s;
  }

  // Returns the corner opposite to `side` in the triangle beyond `side`.
  Index facing(const EdgeOfTriangle& side) const {
    const Index s = mesh_.neighbours[side.triangle][side.apex];
    return mesh_.triangles[s][(place_of(s, corner(side, 1)) + 1) % 3];
  }

  bool flip_until(Index a, Index b) {
    std::deque<EdgeEnds> crossed;
    if (!collect(a, b, crossed)) return false;
    std::vector<EdgeEnds> made;
    for (std::size_t idle = 0; !crossed.empty() && idle <= crossed.size();) {
      const auto [u, v] = crossed.front();
      crossed.pop_front();
      const EdgeOfTriangle side = find(u, v);
      const Index p = corner(side, 0), q = facing(side);
      if (!is_crossing(p, q, u, v)) {
        crossed.push_back({u, v});
        ++idle;
        continue;
      }
      flip(side);
      idle = 0;
      if (is_crossing(a, b, p, q))
        crossed.push_back({p, q});
      else if (key(p, q) != key(a, b))
        made.push_back({p, q});
    }
    restore(made);
    return crossed.empty();
  }

  // Flips new edges that are not locally Delaunay.
  void restore(const std::vector<EdgeEnds>& made) {
    for (const auto& [u, v] : made) {
      const EdgeOfTriangle side = find(u, v);
      if (side.triangle == no_index || held_.contains(key(u, v))) continue;
      if (mesh_.neighbours[side.triangle][side.apex] == no_index) continue;
      const Index p = corner(side, 0), q = facing(side);
      const bool is_bad =
          incircle(points_[p], points_[corner(side, 1)], points_[corner(side, 2)], points_[q]) > 0;
      if (is_bad && is_crossing(p, q, u, v)) flip(side);
    }
  }

  std::span<const Vec2> points_;
  Triangulation& mesh_;
  std::vector<Index> at_;  // per point: one of its triangles
  std::unordered_set<std::uint64_t> held_;
};

}  // namespace

HeldTriangulation delaunay_with(std::span<const Vec2> points, std::span<const EdgeEnds> wanted) {
  HeldTriangulation made{delaunay(points), {}};
  EdgeHolder holder(points, made.mesh);
  for (const auto& [a, b] : wanted) made.is_held.push_back(holder.hold(a, b));
  return made;
}

}  // namespace relievo
