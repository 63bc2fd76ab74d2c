#include "plate_ground.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "geometry/convex_polygon.h"
#include "ground_mesh.h"

namespace relievo {
namespace {

// A line along the outline where the ground bends.
struct Ledge {
  double inward_mm = 0, height_mm = 0;  // from the outline; above the ground
};

// From the outside in.
std::vector<Ledge> ledges_of(const RimOptions& rim) {
  if (rim.width_mm == 0) return {{}};
  std::vector<Ledge> ledges;
  const bool is_groove = rim.height_mm < 0;
  const double outer = is_groove ? rim.width_mm + rim.bevel_mm : 0;
  if (is_groove) ledges = {{0, 0}, {rim.width_mm, 0}};
  ledges.push_back({outer, rim.height_mm});
  if (rim.bevel_mm < rim.width_mm) ledges.push_back({outer + rim.width_mm - rim.bevel_mm, rim.height_mm});
  ledges.push_back({outer + rim.width_mm, 0});
  return ledges;
}

}  // namespace

Ground ground_around(const Front& front, const Box& box, const PlateOptions& options) {
  const double beyond_rim = ledges_of(options.rim).back().inward_mm - options.rim.width_mm;
  if (options.outline == Outline::rectangle) {
    const Vec2 corner = Vec2::Constant(options.margin_mm + options.rim.width_mm + beyond_rim),
               size = box.size().head<2>() + corner + corner;
    return {{{0, 0}, {size.x(), 0}, size, {0, size.y()}}, corner};
  }
  std::vector<Vec2> hull;
  for (const Index i : front.hull) hull.push_back((front.points[i] - box.min).head<2>());
  const double margin = options.margin_mm + options.rim.width_mm;
  Ground ground{inset(outline_around(hull, {options.outline, options.corner_mm, margin}), -beyond_rim)};
  Vec2 min = ground.outline[0];
  for (const Vec2& p : ground.outline) min = min.cwiseMin(p);
  for (Vec2& p : ground.outline) p -= min;
  ground.corner = -min;
  return ground;
}

std::vector<Vec2> foot_polygon(const Ground& ground, const RimOptions& rim) {
  return inset(ground.outline, ledges_of(rim).back().inward_mm);
}

Loop add_ground(Solid& solid, const Front& front, const Ground& ground, const GroundOptions& options) {
  Loop hull = front.hull;
  const double ground_z = solid.points[hull[0]].z(), spacing = options.spacing;
  std::vector<Ledge> ledges = ledges_of(options.rim);
  if (std::isfinite(spacing)) {
    const std::vector<Vec2> foot = subdivided(foot_polygon(ground, options.rim), spacing);
    if (Loop filled = fill_ground(solid, front, foot, spacing); !filled.empty()) {
      hull = std::move(filled);
      ledges.pop_back();
    }
  }
  double height = 0;
  for (const Ledge& ledge : ledges | std::views::reverse) {
    const std::vector<Vec2> polygon = subdivided(inset(ground.outline, ledge.inward_mm), spacing);
    Loop outer = add_loop(solid, polygon, ground_z + ledge.height_mm);
    add_ring(solid, std::move(hull), outer);
    const bool is_level = ledge.height_mm == height;
    solid.regions.resize(solid.triangles.size(), is_level ? Region::ground : Region::bevel);
    height = ledge.height_mm;
    hull = std::move(outer);
  }
  return hull;
}

}  // namespace relievo
