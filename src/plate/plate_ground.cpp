#include "plate/plate_ground.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "core/lists.h"
#include "geometry/plane.h"

namespace relievo {
namespace {

Vec2 edge(const Solid& solid, const IndexPolygon& polygon, std::size_t i) {
  return (solid.points[polygon[(i + 1) % polygon.size()]] - solid.points[polygon[i]]).head<2>();
}

// Rotates the order of the polygon's vertices until the lowest one (of several, the leftmost) is first.
// Then the angles of its edges increase from 0 to 2 pi.
void begin_at_lowest(const Solid& solid, IndexPolygon& polygon) {
  const auto is_lower = [&](Index a, Index b) {
    const Vec3 &p = solid.points[a], &q = solid.points[b];
    return p.y() != q.y() ? p.y() < q.y() : p.x() < q.x();
  };
  std::ranges::rotate(polygon, std::ranges::min_element(polygon, is_lower));
}

// Returns whether the angle of `a`, in [0, 2 pi), is smaller than the angle of `b`. Angles that differ only by
// rounding are equal, because the last digits of cosines depend on the C library.
bool has_smaller_angle(const Vec2& a, const Vec2& b) {
  constexpr double rounding = 1e-9;
  const auto is_lower_half = [](const Vec2& v) { return v.y() < (v.x() < 0 ? -rounding * v.x() : 0); };
  if (is_lower_half(a) != is_lower_half(b)) return is_lower_half(b);
  return cross(a, b) > rounding * a.norm() * b.norm();
}

// A corner of the rim's cross-section.
struct RimProfilePoint {
  double inward_mm = 0;  // distance from the outline
  double height_mm = 0;  // above the ground
};

// Returns the rim's cross-section, from the outline inwards. If there is no rim, it is the outline alone.
std::vector<RimProfilePoint> rim_profile(const RimOptions& rim) {
  if (rim.width_mm == 0) return {{}};
  std::vector<RimProfilePoint> profile;
  const bool is_groove = rim.height_mm < 0;
  const double outer = is_groove ? rim.width_mm + rim.bevel_mm : 0;
  if (is_groove) profile = {{0, 0}, {rim.width_mm, 0}};
  profile.push_back({outer, rim.height_mm});
  if (rim.bevel_mm < rim.width_mm) profile.push_back({outer + rim.width_mm - rim.bevel_mm, rim.height_mm});
  profile.push_back({outer + rim.width_mm, 0});
  return profile;
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

// Merges the edges of both polygons by the angle of their outward normals. Each edge forms a triangle with
// the vertex of the other polygon that is farthest along the edge's normal. These triangles sweep the ring
// once, so none overlap. Every triangle has an area, even where points are collinear or edges are parallel.
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

PlateOutline outline_of_plate(const HeightFieldMesh& front, const Box& box, const PlateOptions& options) {
  const double beyond_rim = rim_profile(options.rim).back().inward_mm - options.rim.width_mm;
  if (is_box(options.outline)) {
    const Vec2 inner = box.size().head<2>();
    Vec2 corner = Vec2::Constant(options.margin_mm + options.rim.width_mm + beyond_rim);
    if (options.size_mm.x() > 0) corner = (options.size_mm - inner) / 2 + Vec2::Constant(beyond_rim);
    const Vec2 size = inner + corner + corner;
    return {{{0, 0}, {size.x(), 0}, size, {0, size.y()}}, corner + options.shift_mm};
  }
  std::vector<Vec2> hull;
  for (const Index i : front.hull) hull.push_back((front.points[i] - box.min).head<2>());
  const double margin = options.margin_mm + options.rim.width_mm;
  PlateOutline outline{inset(
      outline_around(hull, {options.outline, options.corner_mm, margin, options.size_mm}), -beyond_rim)};
  Vec2 min = outline.polygon[0];
  for (const Vec2& p : outline.polygon) min = min.cwiseMin(p);
  for (Vec2& p : outline.polygon) p -= min;
  outline.front_corner = options.shift_mm - min;
  return outline;
}

std::vector<RimEdge> rim_edges(const PlateOutline& outline, const RimOptions& rim) {
  std::vector<RimEdge> edges;
  for (const RimProfilePoint& point : rim_profile(rim) | std::views::reverse)
    edges.push_back({inset(outline.polygon, point.inward_mm), point.height_mm});
  return edges;
}

std::vector<Vec2> rim_inner_polygon(const PlateOutline& outline, const RimOptions& rim) {
  return rim_edges(outline, rim).front().polygon;
}

IndexPolygon add_ground(Solid& solid, const HeightFieldMesh& front, const PlateOutline& outline,
                        const GroundOptions& options) {
  IndexPolygon ring = front.hull;
  const double ground_z = solid.points[ring[0]].z(), spacing = options.spacing;
  std::vector<RimEdge> edges = rim_edges(outline, options.rim);
  if (std::isfinite(spacing)) {
    const std::vector<Vec2> rim_inner = subdivided(edges.front().polygon, spacing);
    if (IndexPolygon filled = fill_ground(solid, front, rim_inner, spacing); !filled.empty()) {
      ring = std::move(filled);
      edges.erase(edges.begin());
    }
  }
  double height = 0;
  for (const RimEdge& edge : edges) {
    IndexPolygon outer = add_polygon(solid, subdivided(edge.polygon, spacing), ground_z + edge.height_mm);
    add_ring(solid, std::move(ring), outer);
    const bool is_level = edge.height_mm == height;
    solid.regions.resize(solid.triangles.size(), is_level ? Region::ground : Region::bevel);
    height = edge.height_mm;
    ring = std::move(outer);
  }
  return ring;
}

}  // namespace relievo
