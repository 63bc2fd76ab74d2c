#include "plate/plate_surface.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/lists.h"
#include "geometry/weld.h"
#include "plate/coincident_points.h"
#include "plate/deformation.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

// Between the bent plate and the axis, at least this share of the wrap's smallest radius must stay free, so
// that no point reaches the axis.
constexpr double least_free = .01;

// Returns the points of the plate's back. The back is flat before bending and has the extent of the plate.
std::vector<Vec2> back_of(const Solid& plate) {
  std::vector<Vec2> places;
  for (std::size_t t = plate.front_triangles; t < plate.triangles.size(); ++t)
    for (const Index i : plate.triangles[t])
      if (plate.points[i].z() == 0) places.emplace_back(plate.points[i].head<2>());
  return places;
}

// Subdivides the plate's triangles until they can be bent. Returns the error in mm. The triangles of a simplified
// plate approximate the relief on a surface that is curved by Wrap::sag(). So they are compared with the bent
// triangles on that surface, where they are flat.
double refine_for(const Wrap& wrap, Solid& plate, const PlateOptions& options) {
  const auto sag = [&](const Vec3& p) { return options.simplify_mm > 0 ? wrap.sag(p.head<2>()) : 0.; };
  const auto lift = [&](double sign) {
    parallel_for(plate.points.size(),
                 [&](std::size_t i) { plate.points[i].z() += sign * sag(plate.points[i]); });
  };
  Deformation deformation;
  deformation.at = [&](const Vec3& p) { return wrap.at(p.head<2>(), p.z() - sag(p) - plate.ground_mm); };
  deformation.min_feature_mm = wrap.min_radius_mm();
  IndexPolygon no_outline;
  lift(1);
  const double error_mm = refine(plate, no_outline, deformation, options.tolerance_mm);
  lift(-1);
  return error_mm;
}

// A point on one of the plate's two sides that will be joined.
struct SidePoint {
  double along, z;
  Index point;
};

// Returns the points on the side of the plate that faces the given direction, sorted along the side and by height.
std::vector<SidePoint> side_of(const Solid& plate, const Vec2& direction) {
  const Vec2 along(std::abs(direction.y()), std::abs(direction.x()));
  double farthest = 0, nearest = 0;
  std::vector<double> distance;
  for (const Vec3& p : plate.points) distance.push_back(direction.dot(p.head<2>()));
  for (const Triangle& t : plate.triangles)
    for (const Index i : t)
      farthest = std::max(farthest, distance[i]), nearest = std::min(nearest, distance[i]);
  const double near_side =
      std::max(1e-4, 1e-6 * (farthest - nearest));  // more than convexity_offset() can move points
  const std::vector<std::uint8_t> is_used = used_points(plate.points.size(), plate.triangles);
  std::vector<SidePoint> side;
  for (Index i = 0; i < distance.size(); ++i)
    if (is_used[i] && distance[i] > farthest - near_side)
      side.push_back({along.dot(plate.points[i].head<2>()), plate.points[i].z(), i});
  std::ranges::sort(side, {}, [](const SidePoint& p) { return std::tuple(p.along, p.z); });
  return side;
}

// Joins the plate's two sides that meet after bending, and removes their walls.
Result<void> close_ring(Solid& plate, const Vec2& across) {
  const std::vector<SidePoint> left = side_of(plate, -across), right = side_of(plate, across);
  std::vector<Index> other = all_indices(plate.points.size());
  bool is_good = left.size() == right.size();
  for (std::size_t i = 0; is_good && i < left.size(); ++i) {
    is_good = std::abs(left[i].along - right[i].along) + std::abs(left[i].z - right[i].z) < 1e-6;
    other[right[i].point] = left[i].point;
  }
  if (!is_good) return geometry_error("wrap", "expected sides that fit each other, found others");
  std::vector<std::uint8_t> is_side(plate.points.size(), 0);
  for (const SidePoint& p : left) is_side[p.point] = 1;
  for (const SidePoint& p : right) is_side[p.point] = 1;
  std::vector<Triangle> triangles;
  for (Triangle t : plate.triangles) {
    if (std::ranges::all_of(t, [&](Index i) { return is_side[i] != 0; })) continue;
    for (Index& i : t) i = other[i];
    triangles.push_back(t);
  }
  // No triangle of the front lies entirely on a side, so front_triangles stays valid.
  plate.triangles = std::move(triangles);
  drop_unused(plate);
  return {};
}

}  // namespace

Result<void> check_room(const Wrap& wrap, double bottom_mm, double highest_mm) {
  const double towards_axis = wrap.is_inside() ? highest_mm : bottom_mm;
  const double room = (1 - least_free) * wrap.min_radius_mm();
  if (towards_axis <= room) return {};
  return option_error(
      "wrap", cat("expected a diameter of at least ",
                  wrap.diameter_mm() + 2 * (towards_axis / (1 - least_free) - wrap.min_radius_mm()),
                  " mm, as ", towards_axis, " mm reach towards the axis, found ", wrap.diameter_mm()));
}

Result<void> check_closed(const PlateOptions& options, const Wrap& wrap) {
  if (!wrap.is_closed()) return {};
  // The computed cosine of a right angle may be 6e-17 instead of 0.
  const bool is_straight = wrap.across().cwiseAbs().minCoeff() < 1e-12;
  if (is_box(options.outline) && options.rim.width_mm == 0 && is_straight) return {};
  return option_error("wrap",
                      "expected outline rectangle, no rim and an upright or level axis for a full turn");
}

Result<Wrap> plate_wrap(const Solid& plate, const PlateOptions& options) {
  return Wrap::around(options.wrap, back_of(plate));
}

Result<Solid> wrap_plate(const Solid& plate, const PlateOptions& options) {
  if (options.wrap.kind == WrapKind::none)
    return option_error("wrap", "expected cylinder, cone or sphere, found none");
  RELIEVO_TRY(const Wrap wrap, plate_wrap(plate, options));
  const double highest = used_box(plate.points, plate.triangles).max.z();
  RELIEVO_CHECK(check_room(wrap, plate.ground_mm, highest - plate.ground_mm));
  Solid body = plate;
  body.error_mm += refine_for(wrap, body, options);
  RELIEVO_CHECK(check_closed(options, wrap));
  if (wrap.is_closed()) RELIEVO_CHECK(close_ring(body, wrap.across()));
  parallel_for(body.points.size(), [&](std::size_t i) {
    body.points[i] = wrap.at(body.points[i].head<2>(), body.points[i].z() - plate.ground_mm);
  });
  const Box box = used_box(body.points, body.triangles);
  for (Vec3& p : body.points) p -= box.min;
  separate_coincident(body, box.size().z() / 2);
  return body;
}

}  // namespace relievo
