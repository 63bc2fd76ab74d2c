#include "plate/plate_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "geometry/plane.h"
#include "lettering/ornament_shapes.h"
#include "plate/deformation.h"
#include "relievo/core/parallel.h"
#include "relievo/plate/simplify.h"

namespace relievo {
namespace {

Region region_of(const HeightFieldMesh& front, const Triangle& t) {
  const double z = front.points[t[0]].z();
  const bool is_level = front.points[t[1]].z() == z && front.points[t[2]].z() == z;
  return is_level ? Region::ground : Region::relief;
}

// Returns a solid that has only the front. The lower corner of its box is at `corner`.
Solid placed_front(const HeightFieldMesh& front, const Box& box, const Vec3& corner) {
  Solid solid;
  solid.points.reserve(front.points.size() + 8);
  // p - box.min comes first, because then the sum is exact for the box's corner.
  for (const Vec3& p : front.points) solid.points.push_back((p - box.min) + corner);
  solid.triangles = front.triangles;
  for (const Triangle& t : front.triangles) solid.regions.push_back(region_of(front, t));
  solid.colours = front.colours;
  solid.shift = corner - box.min;
  solid.ground_mm = front.ground_mm + solid.shift.z();
  return solid;
}

// Sets the region of each triangle. Outside the rim's inner polygon it is the bevel. Inside, it is the ground
// if all corners are at the height of the ground, and the relief otherwise.
void find_regions(Solid& surface, std::span<const Vec2> rim_inner, double ground_z, double tolerance_mm) {
  surface.regions.resize(surface.triangles.size());
  parallel_for(surface.triangles.size(), [&](std::size_t i) {
    const Triangle& t = surface.triangles[i];
    const auto is_low = [&](Index p) { return std::abs(surface.points[p].z() - ground_z) <= tolerance_mm; };
    const Vec3 sum = surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]];
    const bool is_on_rim = !is_within(sum.head<2>() / 3, rim_inner);
    surface.regions[i] = is_on_rim                        ? Region::bevel
                         : std::ranges::all_of(t, is_low) ? Region::ground
                                                          : Region::relief;
  });
}

Result<void> add_ornaments(Solid& surface, const PlateOutline& outline, const PlateOptions& options) {
  if (options.ornaments.empty()) return {};
  const OrnamentFrame frame = ornament_frame(outline, options);
  RELIEVO_TRY(const std::vector<RaisedShape> shapes, ornament_shapes(options.ornaments, frame));
  return add_shapes(surface, shapes, frame.inner);
}

Result<PlateSurface> flat_plate_surface(const HeightFieldMesh& front, const PlateOptions& options,
                                        double spacing) {
  const Box box = used_box(front.points, front.triangles);
  if (options.outline == Outline::none) {
    if (!options.ornaments.empty())
      return option_error("text", "expected an outline with ground for it, found none");
    PlateSurface surface{placed_front(front, box, Vec3::Zero()), {}, spacing};
    if (options.tool) make_reachable(surface, *options.tool, {});
    return surface;
  }
  const PlateOutline outline = outline_of_plate(front, box, options);
  PlateSurface surface{
      placed_front(front, box, {outline.front_corner.x(), outline.front_corner.y(), 0}), {}, spacing};
  surface.outline = add_ground(surface.solid, front, outline, {options.rim, spacing});
  RELIEVO_CHECK(add_ornaments(surface.solid, outline, options));
  fill_colours(surface.solid);
  if (!options.tool) return surface;
  make_reachable(surface, *options.tool, rim_edges(outline, options.rim));
  find_regions(surface.solid, rim_inner_polygon(outline, options.rim), surface.solid.ground_mm, 1e-6);
  return surface;
}

// Returns the polygon inside the rim; empty for a plate without ground.
std::vector<Vec2> rim_inner_of(const HeightFieldMesh& front, const PlateOptions& options) {
  if (options.outline == Outline::none) return {};
  return rim_inner_polygon(outline_of_plate(front, used_box(front.points, front.triangles), options),
                           options.rim);
}

// Returns points that enclose the plate, in the front's coordinates. They are the plate's outline or,
// for a plate without ground, the relief's points.
std::vector<Vec2> extent_of(const HeightFieldMesh& front, const PlateOptions& options) {
  std::vector<Vec2> outline;
  if (options.outline == Outline::none) {
    for (const Triangle& t : front.triangles)
      for (const Index i : t) outline.push_back(front.points[i].head<2>());
    return outline;
  }
  const Box box = used_box(front.points, front.triangles);
  const PlateOutline plate = outline_of_plate(front, box, options);
  for (const Vec2& p : plate.polygon) outline.push_back(p - plate.front_corner + box.min.head<2>());
  return outline;
}

// The curved surface that a plate's surface must follow, in the front's coordinates.
struct TargetSurface {
  Deformation deformation;
  // The height of the curved surface above the plane. For a wrap it is the height of a similarly curved
  // height field, because triangles that approximate this field also approximate the wrap.
  std::function<double(const Vec2&)> height;
  bool is_lifted = false;  // whether the surface gets this height now; a wrap bends the plate later
};

TargetSurface target_on(const Base& base) {
  TargetSurface target;
  target.is_lifted = true;
  target.height = [&base](const Vec2& p) { return base.height(p); };
  target.deformation.at = [&base](const Vec3& p) {
    return Vec3(p.x(), p.y(), p.z() + base.height(p.head<2>()));
  };
  target.deformation.crease_between = [&base](const Vec3& p, const Vec3& q) {
    return base.ridge_between(p.head<2>(), q.head<2>());
  };
  target.deformation.min_feature_mm = base.min_feature_mm();
  return target;
}

TargetSurface target_around(const Wrap& wrap, double ground_z) {
  TargetSurface target;
  target.height = [wrap](const Vec2& p) { return wrap.sag(p); };
  target.deformation.at = [wrap, ground_z](const Vec3& p) { return wrap.at(p.head<2>(), p.z() - ground_z); };
  target.deformation.min_feature_mm = wrap.min_radius_mm();
  return target;
}

TargetSurface moved(TargetSurface target, const Vec3& shift) {
  target.height = [height = target.height, shift](const Vec2& p) { return height(p + shift.head<2>()); };
  target.deformation.at = [at = target.deformation.at, shift](const Vec3& p) {
    return Vec3(at(p + shift) - shift);
  };
  if (target.deformation.crease_between)
    target.deformation.crease_between = [between = target.deformation.crease_between, shift](const Vec3& p,
                                                                                             const Vec3& q) {
      return between(p + shift, q + shift);
    };
  return target;
}

// Returns the deformation that lifts each point by the target's height.
Deformation lifting(const TargetSurface& target) {
  Deformation deformation = target.deformation;
  deformation.at = [height = target.height](const Vec3& p) {
    return Vec3(p.x(), p.y(), p.z() + height(p.head<2>()));
  };
  return deformation;
}

void lift(std::vector<Vec3>& points, const TargetSurface& target, double sign) {
  parallel_for(points.size(),
               [&](std::size_t i) { points[i].z() += sign * target.height(points[i].head<2>()); });
}

// Returns the plate's surface as a height field inside its outline, without unused points.
HeightFieldMesh as_front(const PlateSurface& surface) {
  HeightFieldMesh front{surface.solid.points, surface.solid.triangles, surface.outline};
  front.colours = surface.solid.colours;
  const UsedPoints used = drop_unused(front);
  for (Index& i : front.hull) i = used.new_number[i];
  return front;
}

// Simplifies a surface that already follows its target.
Result<void> simplify_surface(PlateSurface& surface, const SimplifyOptions& options) {
  RELIEVO_TRY(SimplifiedMesh simpler, simplify(as_front(surface), options));
  surface.solid.points = std::move(simpler.front.points);
  surface.solid.triangles = std::move(simpler.front.triangles);
  surface.solid.colours = std::move(simpler.front.colours);
  surface.solid.error_mm += simpler.error_mm;
  surface.outline = std::move(simpler.front.hull);
  return {};
}

// Simplifies a flat surface, if the options ask for simplification.
Result<void> simplify_flat(PlateSurface& surface, const PlateOptions& options,
                           std::span<const Vec2> rim_inner) {
  if (options.simplify_mm == 0 || surface.outline.empty()) return {};
  const double ground_z = surface.solid.ground_mm;
  RELIEVO_CHECK(simplify_surface(surface, {options.simplify_mm, options.max_slope, options.most_triangles}));
  find_regions(surface.solid, rim_inner, ground_z, options.simplify_mm);
  return {};
}

// Makes the flat surface follow the target, which is given in the surface's coordinates. The surface is
// simplified in its curved state, because the tolerance applies to that state. Regions are found in the flat
// state, in which the ground is level.
Result<void> follow(PlateSurface& surface, const TargetSurface& target, const PlateOptions& options,
                    std::span<const Vec2> rim_inner) {
  const bool is_simplified = options.simplify_mm > 0 && !surface.outline.empty();
  const double ground_z = surface.solid.ground_mm;
  // A wrap that is not simplified needs nothing here, because wrap_plate() later refines the whole plate.
  if (!is_simplified && !target.is_lifted) return {};
  surface.solid.error_mm = refine(surface.solid, surface.outline, lifting(target), options.tolerance_mm);
  lift(surface.solid.points, target, 1);
  if (!is_simplified) return {};
  RELIEVO_CHECK(simplify_surface(surface, {options.simplify_mm, options.max_slope, options.most_triangles}));
  lift(surface.solid.points, target, -1);
  find_regions(surface.solid, rim_inner, ground_z, options.simplify_mm);
  if (target.is_lifted) lift(surface.solid.points, target, 1);
  return {};
}

// Returns the distance between points on the bottom of a plate whose points on the ground have the distance `spacing`.
// The bottom of a plate on a base is flat and needs few points. The back of a wrap may use half the tolerance.
double bottom_spacing(const TargetSurface& target, std::span<const Vec2> outline, double ground_z,
                      double spacing, const PlateOptions& options) {
  if (options.wrap.kind == WrapKind::none)
    return std::max(spacing, Box::of(outline).size().head<2>().minCoeff() / 8);
  return ground_spacing(target.deformation, outline, ground_z,
                        options.tolerance_mm + options.simplify_mm / 2);
}

}  // namespace

void fill_colours(Solid& solid) {
  if (!solid.colours.empty()) solid.colours.resize(solid.points.size(), plate_colour);
}

Result<Base> base_under(const HeightFieldMesh& front, const PlateOptions& options) {
  if (options.base.kind == BaseKind::plane) return Base();
  return Base::over(options.base, extent_of(front, options));
}

Result<PlateSurface> make_plate_surface(const HeightFieldMesh& front, const Base& base,
                                        const PlateOptions& options) {
  const double none = std::numeric_limits<double>::infinity();
  const bool is_wrapped = options.wrap.kind != WrapKind::none;
  if (base.is_plane() && !is_wrapped) {
    RELIEVO_TRY(PlateSurface surface, flat_plate_surface(front, options, none));
    RELIEVO_CHECK(simplify_flat(surface, options, rim_inner_of(front, options)));
    return surface;
  }
  const std::vector<Vec2> outline = extent_of(front, options);
  TargetSurface target = target_on(base);
  if (is_wrapped) {
    RELIEVO_TRY(const Wrap wrap, Wrap::around(options.wrap, outline));
    target = target_around(wrap, front.ground_mm);
  }
  const double spacing =
      options.outline == Outline::none
          ? none
          : ground_spacing(target.deformation, outline, front.ground_mm, options.tolerance_mm);
  RELIEVO_TRY(PlateSurface surface, flat_plate_surface(front, options, spacing));
  if (std::isfinite(spacing))
    surface.spacing = bottom_spacing(target, outline, front.ground_mm, spacing, options);
  const std::vector<Vec2> rim_inner = rim_inner_of(front, options);
  RELIEVO_CHECK(follow(surface, moved(std::move(target), -surface.solid.shift), options, rim_inner));
  return surface;
}

}  // namespace relievo
