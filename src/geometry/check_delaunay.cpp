// Proof that these local checks are sufficient.
// 1. Each triangle is linked with its neighbours across equal edges, and the edges without a neighbour are
//    those of the hull. So the linked triangles form a surface bounded by the hull.
// 2. All triangles are counter-clockwise, so each point of the plane is covered as often as the hull winds
//    around it. The hull turns left only, once around: it winds once around each point inside, and around no
//    other. So the triangles cover the hull without gaps or overlaps.
// 3. If no edge has a corner beyond it inside its triangle's circle, no point lies in any triangle's circle
//    (B. Delaunay, "Sur la sphere vide", 1934).
#include <algorithm>
#include <numeric>

#include "geometry/predicates.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {
namespace {

using Points = std::span<const Vec2>;

struct Edge {
  Index from, to;
};

// Returns the edge opposite to corner i.
Edge edge(const Triangle& corners, std::size_t i) {
  return {corners[(i + 1) % 3], corners[(i + 2) % 3]};
}

std::string name(const char* what, std::size_t i) {
  return std::string(what) + " " + std::to_string(i);
}
std::string name(const Edge& e) {
  return name("edge", e.from) + name(" to", e.to);
}

int orientation(Points points, const Triangle& t) {
  return orient2d(points[t[0]], points[t[1]], points[t[2]]);
}

// Returns the corner of triangle `n` that faces triangle t across t's edge `e`; 3 if there is none.
std::size_t facing_corner(const Triangulation& it, Index n, Index t, const Edge& e) {
  for (std::size_t j = 0; j < 3; ++j) {
    const Edge back = edge(it.triangles[n], j);
    if (it.neighbours[n][j] == t && back.from == e.to && back.to == e.from) return j;
  }
  return 3;
}

// Everything that the later checks use as an index must be one, and the predicates must be exact.
std::string check_numbers(Points points, const Triangulation& it) {
  if (it.neighbours.size() != it.triangles.size()) return "as many neighbours as triangles expected";
  const auto outside = std::find_if_not(points.begin(), points.end(), is_exact_point);
  if (outside != points.end()) return name("point", outside - points.begin()) + ": coordinates out of range";
  const auto is_point = [&](Index i) { return i < points.size(); };
  const auto is_neighbour = [&](Index t) { return t < it.triangles.size() || t == no_index; };
  for (std::size_t t = 0; t < it.triangles.size(); ++t) {
    const Triangle &corners = it.triangles[t], &neighbours = it.neighbours[t];
    if (!std::all_of(corners.begin(), corners.end(), is_point))
      return name("triangle", t) + ": no such point";
    if (!std::all_of(neighbours.begin(), neighbours.end(), is_neighbour)) {
      return name("triangle", t) + ": no such neighbour";
    }
  }
  if (!std::all_of(it.hull.begin(), it.hull.end(), is_point)) return "hull: no such point";
  return {};
}

std::string check_orientation(Points points, const Triangulation& it) {
  for (std::size_t t = 0; t < it.triangles.size(); ++t) {
    if (orientation(points, it.triangles[t]) <= 0) return name("triangle", t) + ": not counter-clockwise";
  }
  return {};
}

std::string check_links_and_circles(Points points, const Triangulation& it) {
  for (Index t = 0; t < it.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Triangle& corners = it.triangles[t];
      const Index n = it.neighbours[t][i];
      if (n == no_index) continue;
      const std::size_t j = facing_corner(it, n, t, edge(corners, i));
      if (j == 3) return name("triangle", t) + ": " + name("triangle", n) + " is no neighbour of it";
      const Index facing = it.triangles[n][j];
      if (incircle(points[corners[0]], points[corners[1]], points[corners[2]], points[facing]) > 0) {
        return name("triangle", t) + ": " + name("point", facing) + " is inside its circle";
      }
    }
  }
  return {};
}

// The edges without a neighbour must be the hull's edges, each once. It is enough to check that each is one
// of the hull's: they form closed polygons, and the hull is a single polygon, so that none of its edges can
// be left over.
std::string check_border(Points points, const Triangulation& it) {
  std::vector<Index> hull_next(points.size(), no_index);
  for (std::size_t k = 0; k < it.hull.size(); ++k) {
    if (hull_next[it.hull[k]] != no_index) return "hull: " + name("point", it.hull[k]) + " appears twice";
    hull_next[it.hull[k]] = it.hull[(k + 1) % it.hull.size()];
  }
  for (std::size_t t = 0; t < it.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (it.neighbours[t][i] != no_index) continue;
      const Edge e = edge(it.triangles[t], i);
      if (hull_next[e.from] != e.to) return name("triangle", t) + ": " + name(e) + " is not on the hull";
      hull_next[e.from] = no_index;  // each edge once
    }
  }
  return {};
}

// The hull may not turn right and must go around once. A closed polygon that only turns left goes around once
// if its direction changes from downwards to upwards once.
std::string check_convexity(Points points, const Triangulation& it) {
  const std::size_t n = it.hull.size();
  const auto corner = [&](std::size_t k) -> const Vec2& { return points[it.hull[k % n]]; };
  const auto is_upwards = [&](std::size_t k) {
    const Vec2 &p = corner(k), &q = corner(k + 1);
    return p.y() < q.y() || (p.y() == q.y() && p.x() < q.x());
  };
  std::size_t turns = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (orient2d(corner(k), corner(k + 1), corner(k + 2)) < 0) {
      return "hull: turns right at " + name("point", it.hull[(k + 1) % n]);
    }
    turns += !is_upwards(k) && is_upwards(k + 1);
  }
  return turns == 1 ? "" : "hull: does not go round once";
}

// Among points with equal coordinates the one with the lowest number must be in a triangle, and no other.
std::string check_use_of_points(Points points, const Triangulation& it) {
  std::vector<bool> is_used(points.size(), false);
  for (const Triangle& corners : it.triangles) {
    for (const Index i : corners) is_used[i] = true;
  }
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Vec2 &p = points[a], &q = points[b];
    return p.x() != q.x() ? p.x() < q.x() : p.y() != q.y() ? p.y() < q.y() : a < b;
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_coincident = k > 0 && points[order[k]] == points[order[k - 1]];
    if (is_used[order[k]] != is_coincident) continue;
    return name("point", order[k]) +
           (is_coincident ? ": used, but not the first at its place" : ": in no triangle");
  }
  return {};
}

// A result without triangles is right if all points are on one line. That is so if all are on one line with
// the first point and the first one that differs from it.
std::string check_empty(Points points, const Triangulation& it) {
  if (!it.neighbours.empty() || !it.hull.empty()) return "hull or neighbours without triangles";
  if (!std::all_of(points.begin(), points.end(), is_exact_point)) return {};
  Index b = 0;
  while (b < points.size() && points[b] == points[0]) ++b;
  for (Index c = b; c < points.size(); ++c) {
    if (orientation(points, {0, b, c}) != 0)
      return "no triangles, but points 0, " + std::to_string(b) + ", " + std::to_string(c) + " span one";
  }
  return {};
}

}  // namespace

std::string check_delaunay(std::span<const Vec2> points, const Triangulation& triangulation) {
  if (triangulation.triangles.empty()) return check_empty(points, triangulation);
  for (const auto& check : {check_numbers, check_orientation, check_links_and_circles, check_border,
                            check_convexity, check_use_of_points}) {
    if (std::string wrong = check(points, triangulation); !wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace relievo
