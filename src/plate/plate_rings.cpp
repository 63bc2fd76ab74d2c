#include "plate_rings.h"

#include <algorithm>

namespace relievo {
namespace {

Vec2 edge(const Solid& solid, const Loop& loop, std::size_t i) {
  return (solid.points[loop[(i + 1) % loop.size()]] - solid.points[loop[i]]).head<2>();
}

// Lets the loop begin at its lowest vertex (of several, the leftmost), so that its edges' angles rise from 0
// to 2 pi.
void begin_at_lowest(const Solid& solid, Loop& loop) {
  const auto is_lower = [&](Index a, Index b) {
    const Vec3 &p = solid.points[a], &q = solid.points[b];
    return p.y() != q.y() ? p.y() < q.y() : p.x() < q.x();
  };
  std::ranges::rotate(loop, std::ranges::min_element(loop, is_lower));
}

// Is the angle of `a`, in [0, 2 pi), smaller than that of `b`?
bool has_smaller_angle(const Vec2& a, const Vec2& b) {
  const auto is_lower_half = [](const Vec2& v) { return v.y() < 0 || (v.y() == 0 && v.x() < 0); };
  if (is_lower_half(a) != is_lower_half(b)) return is_lower_half(b);
  return a.x() * b.y() - a.y() * b.x() > 0;
}

}  // namespace

Loop add_loop(Solid& solid, const std::vector<Vec2>& polygon, double z) {
  Loop loop;
  for (const Vec2& p : polygon) {
    loop.push_back(static_cast<Index>(solid.points.size()));
    solid.points.emplace_back(p.x(), p.y(), z);
  }
  return loop;
}

// Both are walked in the order of their edges' outward normals; each edge is joined to the other polygon's
// vertex that is farthest in its normal's direction. The segments between such pairs sweep the ring once, so
// no triangles overlap, and every one has an area, also where points are collinear or edges are parallel.
void add_ring(Solid& solid, Loop inner, Loop outer) {
  begin_at_lowest(solid, inner);
  begin_at_lowest(solid, outer);
  const std::size_t n = inner.size(), m = outer.size();
  for (std::size_t i = 0, j = 0; i < n || j < m;) {
    const bool is_outer_next =
        i == n || (j < m && has_smaller_angle(edge(solid, outer, j), edge(solid, inner, i)));
    if (is_outer_next) {
      solid.triangles.push_back({outer[j], outer[(j + 1) % m], inner[i % n]});
      ++j;
    } else {
      solid.triangles.push_back({inner[(i + 1) % n], inner[i], outer[j % m]});
      ++i;
    }
  }
}

}  // namespace relievo
