// Builds a Delaunay triangulation to which points are added one by one. delaunay() uses it, too. Tested by
// tests/geometry/triangulation_test.cpp and tests/plate/simplify_test.cpp.
#pragma once

#include <utility>
#include <vector>

#include "relievo/geometry/triangulation.h"

namespace relievo {

class DelaunayBuilder {
 public:
  // Keeps a reference to `points`, to which points may be added later. names[i] is the index that points[i] has in
  // the result.
  DelaunayBuilder(const std::vector<Vec2>& points, std::vector<Index> names)
      : points_(points), names_(std::move(names)) {}

  // Starts with the triangle of three points that are not collinear. Returns false if all points are
  // collinear.
  bool start();

  // Inserts a point. The search for its triangle begins at the last inserted point. Returns false if another
  // point has the same position.
  bool insert(Index p);

  // Inserts a point that was added to `points` after construction. Its index in the result is p. The search
  // for its triangle begins at `triangle` or, if that triangle is outside the hull, at the last inserted
  // point.
  bool insert_added(Index p, Index triangle);

  Triangulation result() const;

  // Triangles are numbered from 0 to size() - 1. Only triangles around an inserted point change. Triangles
  // beyond the hull's edges count, too: they are outside and have no area.
  Index size() const { return static_cast<Index>(edges_.size() / 4); }
  bool is_outside(Index triangle) const { return is_ghost(4 * triangle); }
  Triangle corners(Index triangle) const {
    const HalfEdge* const e = &edges_[4 * std::size_t{triangle}];
    return {e[0].origin, e[1].origin, e[2].origin};
  }
  // Returns the triangle on the other side of the edge opposite to a corner; no_index at the hull.
  Index neighbour(Index triangle, Index corner) const {
    const Index other = edges_[4 * triangle + (corner + 1) % 3].twin;
    return is_ghost(other) ? no_index : other / 4;
  }
  // Returns one of the triangles around the last inserted point.
  Index newest() const { return near_ / 4; }

  // Calls f(triangle) for the triangles around the last inserted point, including those outside. The
  // insertion changed no other triangles.
  template <typename F>
  void each_around_newest(F&& f) const {
    Index e = near_;
    do {
      f(e / 4);
      e = next_around(e);
    } while (e != near_);
  }

 private:
  // A side of a triangle, from `origin` counter-clockwise to the next corner.
  struct HalfEdge {
    Index origin;
    Index twin;  // the half-edge of the same side in the neighbouring triangle
  };

  bool is_ghost(Index e) const {
    const HalfEdge* const t = &edges_[e & ~Index{3}];
    return t[0].origin == no_index || t[1].origin == no_index || t[2].origin == no_index;
  }
  Index locate(const Vec2& p) const;
  Index vertex_at(const Vec2& p, Index e) const;
  bool circle_contains(Index e, const Vec2& p) const;
  void link(Index e, Index f) { edges_[e].twin = f, edges_[f].twin = e; }
  void add_triangle(Index a, Index b, Index c);
  Index split(Index e, Index p);
  void flip(Index e);
  // Returns slot 0 of the next triangle around the newest point. `e` is slot 0 of a triangle around this
  // point. All these triangles have the point at slot 2 (see edges_).
  Index next_around(Index e) const { return edges_[e + 1].twin - 2; }

  std::vector<Index> number_triangles() const;
  void append_triangle(Index t, const std::vector<Index>& numbers, Triangulation& to) const;
  std::vector<Index> hull() const;

  const std::vector<Vec2>& points_;
  std::vector<Index> names_;
  // Triangle t has four slots: the half-edges 4 t, 4 t + 1 and 4 t + 2, and an unused one. Thanks to the
  // unused slot, index arithmetic is cheap and no triangle crosses a cache line.
  std::vector<HalfEdge> edges_;
  Index near_ = 0;  // slot 0 of a triangle around the last inserted point, not of a ghost
};

}  // namespace relievo
