// Iterates over the edges of triangles. Each edge comes with all the triangle sides that lie on it.
#pragma once

#include <algorithm>
#include <span>
#include <utility>

#include "core/groups.h"
#include "relievo/core/types.h"

namespace relievo {

// One side of a triangle: its ends and the opposite corner, in the triangle's order.
struct TriangleSide {
  Index from, to, apex;
  Index triangle;  // number of the triangle

  Index low() const { return std::min(from, to); }
  Index high() const { return std::max(from, to); }
};

// Calls f(sides) for each edge. Edges are ordered by their lower end, then by their higher end. `sides` are
// the triangle sides on the edge for which is_wanted(side) is true, in the order of their triangles. Edges
// without such a side are skipped.
template <typename IsWanted, typename F>
void each_edge(std::span<const Triangle> triangles, IsWanted&& is_wanted, F&& f) {
  Index points = 0;
  for (const Triangle& corners : triangles) points = std::max(points, 1 + std::ranges::max(corners));
  auto by_low_end = grouped<TriangleSide>(points, [&](auto&& add) {
    for (Index t = 0; t < triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const Triangle& corners = triangles[t];
        const TriangleSide side{corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3], t};
        if (is_wanted(side)) add(side.low(), side);
      }
  });
  for (Index low = 0; low < points; ++low) {
    const auto sides = std::span(by_low_end.items)
                           .subspan(by_low_end.begin[low], by_low_end.begin[low + 1] - by_low_end.begin[low]);
    std::ranges::sort(sides, {}, [](const TriangleSide& s) { return std::pair(s.high(), s.triangle); });
    for (auto begin = sides.begin(); begin != sides.end();) {
      const auto end = std::find_if_not(begin, sides.end(),
                                        [&](const TriangleSide& s) { return s.high() == begin->high(); });
      f(std::span<const TriangleSide>(begin, end));
      begin = end;
    }
  }
}

// Calls f(sides) for each edge, in the same order, with all triangle sides on the edge.
template <typename F>
void each_edge(std::span<const Triangle> triangles, F&& f) {
  each_edge(
      triangles, [](const TriangleSide&) { return true; }, f);
}

}  // namespace relievo
