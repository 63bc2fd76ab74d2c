// Checks a Delaunay triangulation with a few exact tests of each triangle. These tests are sufficient:
// 1. Each triangle is linked with its neighbours across equal edges, and the edges without a neighbour are
//    those of the hull. So the linked triangles form a surface that is bounded by the hull.
// 2. All triangles are counter-clockwise, so each point of the plane is covered as often as the hull winds
//    around it. The hull turns only left, and only once around. So it winds once around each point inside,
//    and around no other point. Therefore the triangles cover the hull without gaps or overlaps.
// 3. Across each edge, the far corner of the neighbour is not inside the triangle's circle. Then no point is
//    inside the circle of any triangle (B. Delaunay, "Sur la sphere vide", 1934).
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/predicates.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {

// Returns a fault in the links between triangles with a common edge; an empty text if there is none.
inline std::string fault_of_edges(std::span<const Vec2> points, const Triangulation& it) {
  std::map<Index, Index> hull_next;
  for (std::size_t k = 0; k < it.hull.size(); ++k) hull_next[it.hull[k]] = it.hull[(k + 1) % it.hull.size()];
  std::set<Index> on_border;
  for (Index t = 0; t < it.triangles.size(); ++t) {
    const Triangle& corners = it.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = corners[(i + 1) % 3], to = corners[(i + 2) % 3], n = it.neighbours[t][i];
      if (n == no_index) {
        if (!hull_next.contains(from) || hull_next[from] != to || !on_border.insert(from).second)
          return "hull";
        continue;
      }
      const auto is_across = [&](std::size_t j) {
        return it.neighbours[n][j] == t && it.triangles[n][(j + 1) % 3] == to &&
               it.triangles[n][(j + 2) % 3] == from;
      };
      std::size_t j = 0;
      while (j < 3 && !is_across(j)) ++j;
      if (j == 3) return "neighbours";
      const Vec2& facing = points[it.triangles[n][j]];
      if (incircle(points[corners[0]], points[corners[1]], points[corners[2]], facing) > 0) return "circle";
    }
  }
  return on_border.size() == it.hull.size() ? "" : "hull";
}

// Returns whether a closed polygon turns only left, and only once around. If so, the direction of its
// edges changes from downwards to upwards only once.
inline bool goes_round_once(std::span<const Vec2> points, const std::vector<Index>& hull) {
  const auto corner = [&](std::size_t k) -> const Vec2& { return points[hull[k % hull.size()]]; };
  const auto is_upwards = [&](std::size_t k) {
    const Vec2 &p = corner(k), &q = corner(k + 1);
    return p.y() < q.y() || (p.y() == q.y() && p.x() < q.x());
  };
  std::size_t turns = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    if (orient2d(corner(k), corner(k + 1), corner(k + 2)) < 0) return false;
    turns += !is_upwards(k) && is_upwards(k + 1);
  }
  return turns == 1;
}

// Returns a fault of a triangulation; an empty text if there is none. The numbers of the
// triangulation may be arbitrary.
inline std::string delaunay_fault(std::span<const Vec2> points, const Triangulation& it) {
  if (!std::ranges::all_of(points, is_exact_point)) return "coordinates";
  if (it.triangles.empty() || it.neighbours.size() != it.triangles.size()) return "sizes";
  std::map<std::pair<double, double>, Index> first;
  for (Index i = 0; i < points.size(); ++i) first.try_emplace({points[i].x(), points[i].y()}, i);
  std::set<Index> distinct, used;
  for (const auto& [place, i] : first) distinct.insert(i);
  for (const Triangle& corners : it.triangles) used.insert(corners.begin(), corners.end());
  if (used != distinct) return "points";
  for (const Triangle& t : it.triangles)
    if (orient2d(points[t[0]], points[t[1]], points[t[2]]) <= 0) return "orientation";
  for (const Triangle& neighbours : it.neighbours)
    for (const Index n : neighbours)
      if (n >= it.triangles.size() && n != no_index) return "neighbours";
  if (const std::string fault = fault_of_edges(points, it); !fault.empty()) return fault;
  return goes_round_once(points, it.hull) ? "" : "turns";
}

}  // namespace relievo
