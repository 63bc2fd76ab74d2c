#include <algorithm>
#include <cmath>
#include <utility>

#include "plate/coincident_points.h"
#include "plate/front/silhouette.h"
#include "plate/front/thin_triangles.h"
#include "plate/plate_ground.h"
#include "plate/plate_surface.h"
#include "relievo/core/text.h"
#include "relievo/plate/solid.h"

namespace relievo {
namespace {

// Moves the surface so that the z of its lowest point is exactly the thickness, and no x or y is negative.
void raise(Solid& surface, double thickness_mm) {
  const Vec3 begin = used_box(surface.points, surface.triangles).min;
  const Vec3 move(-std::min(0.0, begin.x()), -std::min(0.0, begin.y()), thickness_mm - begin.z());
  for (Vec3& p : surface.points) p = {p.x() + move.x(), p.y() + move.y(), (p.z() - begin.z()) + thickness_mm};
  surface.shift += move;
  surface.ground_mm += move.z();
}

// Adds a point on the bottom below each corner of the polygon `top`. Returns the new points.
IndexPolygon add_below(Solid& solid, const IndexPolygon& top) {
  IndexPolygon bottom;
  for (const Index i : top) {
    bottom.push_back(static_cast<Index>(solid.points.size()));
    const Vec3 p = solid.points[i];
    solid.points.emplace_back(p.x(), p.y(), 0);
  }
  return bottom;
}

void add_walls(Solid& solid, const IndexPolygon& top, const IndexPolygon& bottom) {
  for (std::size_t i = 0; i < top.size(); ++i) {
    const std::size_t next = (i + 1) % top.size();
    solid.triangles.push_back({bottom[i], bottom[next], top[next]});
    solid.triangles.push_back({bottom[i], top[next], top[i]});
  }
}

// Adds the walls under the outline, and the bottom. The bottom is a fan of triangles or, if the
// plate is curved, a lattice.
void close_plate(Solid& solid, const IndexPolygon& outline, double spacing) {
  const IndexPolygon bottom = add_below(solid, outline);
  add_walls(solid, outline, bottom);
  if (std::isfinite(spacing)) return fill_below(solid, bottom, spacing);
  for (std::size_t i = 1; i + 1 < bottom.size(); ++i)
    solid.triangles.push_back({bottom[0], bottom[i + 1], bottom[i]});
}

// Adds the bottom, which is a copy of the front's triangles, and the walls from the boundary of the front to
// that of the bottom.
void close_body(Solid& solid) {
  const std::vector<Triangle> front = solid.triangles;
  const auto n = static_cast<Index>(solid.points.size());
  for (Index i = 0; i < n; ++i) solid.points.emplace_back(solid.points[i].x(), solid.points[i].y(), 0);
  for (const auto& [a, b] : boundary_edges(front)) {
    solid.triangles.push_back({a + n, b + n, b});
    solid.triangles.push_back({a + n, b, a});
  }
  for (const auto& [a, b, c] : front) solid.triangles.push_back({a + n, c + n, b + n});
}

// Returns the solid that has the given surface, with walls and bottom.
Solid closed(PlateSurface surface, const PlateOptions& options) {
  raise(surface.solid, options.thickness_mm);
  surface.solid.error_mm += flip_thin_triangles(surface.solid, surface.outline.empty());
  surface.solid.front_triangles = surface.solid.triangles.size();
  unfold(surface.solid, surface.outline);
  const double highest = used_box(surface.solid.points, surface.solid.triangles).max.z();
  if (options.outline == Outline::none)
    close_body(surface.solid);
  else
    close_plate(surface.solid, surface.outline, surface.spacing);
  separate_coincident(surface.solid, (highest + options.thickness_mm) / 2);
  fill_colours(surface.solid);
  return std::move(surface.solid);
}

// Returns the part of the front that the plate shows. A plate without ground shows only the relief,
// which is then stored in `alone`; other plates show the whole front.
Result<const HeightFieldMesh*> front_shown(const HeightFieldMesh& front, const PlateOptions& options,
                                           HeightFieldMesh& alone) {
  RELIEVO_CHECK(check_plate(front, options));
  if (options.outline != Outline::none) return &front;
  alone = relief_alone(front);
  if (!alone.triangles.empty()) return &alone;
  return geometry_error("front", "expected triangles of the relief, found ground only");
}

// Smaller sizes could make rim or walls degenerate when files round them to single precision.
constexpr double least_size_mm = 1e-3;
constexpr double least_tolerance_mm = 1e-4;  // smaller tolerances would reproduce the rounding of files

bool is_good(double mm) {
  return std::isfinite(mm) && mm >= least_size_mm;
}

std::string wanted_length(double mm) {
  return cat("expected a finite length of at least 0.001 mm, found ", mm);
}

Result<void> check_rim(const PlateOptions& options) {
  const RimOptions& rim = options.rim;
  if (rim.width_mm == 0) return {};
  if (options.outline == Outline::none)
    return option_error("rim", "expected an outline to lie along, found none");
  if (!is_good(rim.width_mm)) return option_error("rim", wanted_length(rim.width_mm));
  if (!is_good(std::abs(rim.height_mm))) return option_error("rim-height", wanted_length(rim.height_mm));
  if (!is_good(rim.bevel_mm) || rim.bevel_mm > rim.width_mm)
    return option_error("rim-bevel", cat("expected 0.001 mm to ", rim.width_mm,
                                         " mm, the rim's width, found ", rim.bevel_mm, " mm"));
  return {};
}

Result<void> check_options(const PlateOptions& options) {
  if (!is_good(options.margin_mm)) return option_error("margin", wanted_length(options.margin_mm));
  if (!is_good(options.thickness_mm)) return option_error("thickness", wanted_length(options.thickness_mm));
  if (options.outline == Outline::round && !is_good(options.corner_mm))
    return option_error("corner", wanted_length(options.corner_mm));
  if (!(options.tolerance_mm >= least_tolerance_mm && std::isfinite(options.tolerance_mm)))
    return option_error("tolerance",
                        cat("expected a finite length of at least 0.0001 mm, found ", options.tolerance_mm));
  return check_rim(options);
}

Result<void> check_front(const HeightFieldMesh& front, bool has_ground) {
  const auto is_bad = [&](Index i) { return i >= front.points.size() || !front.points[i].allFinite(); };
  const auto has_bad_corner = [&](const Triangle& t) { return std::ranges::any_of(t, is_bad); };
  if (front.triangles.empty() || (has_ground && front.hull.size() < 3))
    return geometry_error("front", "expected triangles and a hull around them, found none");
  if (std::ranges::any_of(front.triangles, has_bad_corner) || std::ranges::any_of(front.hull, is_bad))
    return geometry_error("front", "expected corners that are finite points of the front");
  if (!front.colours.empty() && front.colours.size() != front.points.size())
    return geometry_error("front", "expected a colour for each point of the front, or none");
  if (!front.is_relief.empty() && front.is_relief.size() != front.triangles.size())
    return geometry_error("front", "expected to know for each triangle if it is relief, or for none");
  return {};
}

}  // namespace

Result<Base> plate_base(const HeightFieldMesh& front, const PlateOptions& options) {
  HeightFieldMesh alone;
  RELIEVO_TRY(const HeightFieldMesh* const shown, front_shown(front, options, alone));
  return base_under(*shown, options);
}

Result<Solid> make_plate(const HeightFieldMesh& front, const PlateOptions& options) {
  HeightFieldMesh alone;
  RELIEVO_TRY(const HeightFieldMesh* const shown, front_shown(front, options, alone));
  RELIEVO_TRY(const Base base, base_under(*shown, options));
  RELIEVO_TRY(PlateSurface surface, make_plate_surface(*shown, base, options));
  return closed(std::move(surface), options);
}

Result<void> check_plate(const HeightFieldMesh& front, const PlateOptions& options) {
  RELIEVO_CHECK(check_options(options));
  return check_front(front, options.outline != Outline::none);
}

}  // namespace relievo
