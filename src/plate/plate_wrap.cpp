#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "bend.h"
#include "plate/plate_checks.h"
#include "plate_top.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "twins.h"

namespace relievo {
namespace {

// The share of the way to the axis that the body must leave free.
constexpr double least_free = .01;

// Places of the flat back, which reach as far as the plate does.
std::vector<Vec2> back_of(const Solid& plate) {
  std::vector<Vec2> places;
  for (std::size_t t = plate.front_triangles; t < plate.triangles.size(); ++t)
    for (const Index i : plate.triangles[t])
      if (plate.points[i].z() == 0) places.emplace_back(plate.points[i].head<2>());
  return places;
}

Result<void> check_room(const Solid& plate, const Wrap& wrap) {
  const double highest = used_box(plate.points, plate.triangles).max.z();
  const double towards_axis = wrap.is_inside() ? highest - plate.ground_mm : plate.ground_mm;
  const double room = (1 - least_free) * wrap.reach_mm();
  if (towards_axis <= room) return {};
  return plate_error(ErrorKind::option, "--wrap",
                     cat("expected a diameter of at least ",
                         wrap.diameter_mm() + 2 * (towards_axis / (1 - least_free) - wrap.reach_mm()),
                         " mm, as ", towards_axis, " mm reach towards the axis, found ", wrap.diameter_mm()));
}

Result<void> check_closed(const PlateOptions& options, const Wrap& wrap) {
  const bool is_straight = wrap.across().x() == 0 || wrap.across().y() == 0;
  if (options.outline == Outline::rectangle && options.rim.width_mm == 0 && is_straight) return {};
  return plate_error(ErrorKind::option, "--wrap",
                     "expected outline rectangle, no rim and an upright or level axis for a full turn");
}

// A point on a side of the plate that is to meet another.
struct SidePoint {
  double along, z;
  Index point;
};

// Points on the side in this direction, sorted.
std::vector<SidePoint> side_of(const Solid& plate, const Vec2& direction) {
  const Vec2 along(std::abs(direction.y()), std::abs(direction.x()));
  double farthest = 0, nearest = 0;
  std::vector<double> reach;
  for (const Vec3& p : plate.points) reach.push_back(direction.dot(p.head<2>()));
  for (const Triangle& t : plate.triangles)
    for (const Index i : t) farthest = std::max(farthest, reach[i]), nearest = std::min(nearest, reach[i]);
  const double near_side = std::max(1e-4, 1e-6 * (farthest - nearest));  // wider than sides are bulged
  std::vector<std::uint8_t> is_used(plate.points.size(), 0);
  for (const Triangle& t : plate.triangles)
    for (const Index i : t) is_used[i] = 1;
  std::vector<SidePoint> side;
  for (Index i = 0; i < reach.size(); ++i)
    if (is_used[i] && reach[i] > farthest - near_side)
      side.push_back({along.dot(plate.points[i].head<2>()), plate.points[i].z(), i});
  std::ranges::sort(side, {}, [](const SidePoint& p) { return std::tuple(p.along, p.z); });
  return side;
}

// Leaves out the points that no triangle uses.
void drop_unused(Solid& solid) {
  std::vector<Index> place(solid.points.size(), no_index);
  for (const Triangle& t : solid.triangles)
    for (const Index i : t) place[i] = 0;
  Index kept = 0;
  for (Index i = 0; i < place.size(); ++i) {
    if (place[i] == no_index) continue;
    place[i] = kept;
    solid.points[kept] = solid.points[i];
    if (!solid.colours.empty()) solid.colours[kept] = solid.colours[i];
    ++kept;
  }
  solid.points.resize(kept);
  if (!solid.colours.empty()) solid.colours.resize(kept);
  for (Triangle& t : solid.triangles)
    for (Index& i : t) i = place[i];
}

// Makes one of the plate's two sides, whose walls go.
Result<void> close_ring(Solid& plate, const Vec2& across) {
  const std::vector<SidePoint> left = side_of(plate, -across), right = side_of(plate, across);
  std::vector<Index> other(plate.points.size());
  for (Index i = 0; i < other.size(); ++i) other[i] = i;
  bool is_good = left.size() == right.size();
  for (std::size_t i = 0; is_good && i < left.size(); ++i) {
    is_good = std::abs(left[i].along - right[i].along) + std::abs(left[i].z - right[i].z) < 1e-6;
    other[right[i].point] = left[i].point;
  }
  if (!is_good)
    return plate_error(ErrorKind::geometry, "--wrap", "expected sides that fit each other, found others");
  std::vector<std::uint8_t> is_side(plate.points.size(), 0);
  for (const SidePoint& p : left) is_side[p.point] = 1;
  for (const SidePoint& p : right) is_side[p.point] = 1;
  std::vector<Triangle> triangles;
  for (Triangle t : plate.triangles) {
    if (std::ranges::all_of(t, [&](Index i) { return is_side[i] != 0; })) continue;
    for (Index& i : t) i = other[i];
    triangles.push_back(t);
  }
  plate.triangles = std::move(triangles);  // the front's have corners elsewhere: none of them went
  drop_unused(plate);
  return {};
}

}  // namespace

Result<Wrap> plate_wrap(const Solid& plate, const PlateOptions& options) {
  return Wrap::around(options.wrap, back_of(plate));
}

Result<Solid> wrap_plate(const Solid& plate, const PlateOptions& options) {
  if (options.wrap.kind == WrapKind::none)
    return plate_error(ErrorKind::option, "--wrap", "expected cylinder, cone or sphere, found none");
  const Result<Wrap> wrap = plate_wrap(plate, options);
  if (!wrap) return std::unexpected(wrap.error());
  if (auto good = check_room(plate, *wrap); !good) return std::unexpected(good.error());
  Bend bend;
  bend.at = [&](const Vec3& p) { return wrap->at(p.head<2>(), p.z() - plate.ground_mm); };
  bend.feature_mm = wrap->reach_mm();
  Solid body = plate;
  Loop no_outline;
  // A front that was made simpler is off by its own tolerance and is left so.
  const double error_mm = refine(body, no_outline, bend, options.tolerance_mm + 1.5 * options.simplify_mm);
  body.error_mm = options.simplify_mm > 0 ? plate.error_mm + options.tolerance_mm : error_mm;
  if (wrap->is_closed()) {
    if (auto good = check_closed(options, *wrap); !good) return std::unexpected(good.error());
    if (auto good = close_ring(body, wrap->across()); !good) return std::unexpected(good.error());
  }
  parallel_for(body.points.size(), [&](std::size_t i) { body.points[i] = bend.at(body.points[i]); });
  const Box box = used_box(body.points, body.triangles);
  for (Vec3& p : body.points) p -= box.min;
  separate_twins(body, box.size().z() / 2);
  return body;
}

}  // namespace relievo
