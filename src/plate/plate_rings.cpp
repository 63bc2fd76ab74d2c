#include "plate/plate_rings.h"

#include <algorithm>

#include "geometry/plane.h"

namespace relievo {
namespace {

Vec2 edge(const Solid& solid, const IndexPolygon& polygon, std::size_t i) {
  return (solid.points[polygon[(i + 1) % polygon.size()]] - solid.points[polygon[i]]).head<2>();
}

// Rotates the order of the polygon's vertices until its lowest one (of several, the leftmost) is first, so
// that its edges' angles rise from 0 to 2 pi.
void begin_at_lowest(const Solid& solid, IndexPolygon& polygon) {
  const auto is_lower = [&](Index a, Index b) {
    const Vec3 &p = solid.points[a], &q = solid.points[b];
    return p.y() != q.y() ? p.y() < q.y() : p.x() < q.x();
  };
  std::ranges::rotate(polygon, std::ranges::min_element(polygon, is_lower));
}

// Returns true if the angle of `a`, in [0, 2 pi), is smaller than that of `b`.
bool has_smaller_angle(const Vec2& a, const Vec2& b) {
  const auto is_lower_half = [](const Vec2& v) { return v.y() < 0 || (v.y() == 0 && v.x() < 0); };
  if (is_lower_half(a) != is_lower_half(b)) return is_lower_half(b);
  return cross(a, b) > 0;
}

}  // namespace

IndexPolygon add_polygon(Solid& solid, const std::vector<Vec2>& corners, double z) {
  IndexPolygon polygon;
  for (const Vec2& p : corners) {
    polygon.push_back(static_cast<Index>(solid.points.size()));
    solid.points.emplace_back(p.x(), p.y(), z);
  }
  return polygon;
}

// Visits the edges of both polygons in the order of their outward normals' angles, and connects each edge to
// the other polygon's vertex that is farthest along its normal. The segments between such pairs sweep the
// ring once, so no triangles overlap, and every triangle has an area, even where points are collinear or
// edges are parallel.
void add_ring(Solid& solid, IndexPolygon inner, IndexPolygon outer) {
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
