#include "plate_top.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "bend.h"
#include "ground_mesh.h"
#include "plate_ground.h"
#include "relievo/core/parallel.h"
#include "relievo/simplify.h"

namespace relievo {
namespace {

constexpr Colour plate_colour = {200, 200, 200};  // of the ground, walls and bottom of a coloured relief

Region region_of(const Front& front, const Triangle& t) {
  const double z = front.points[t[0]].z();
  const bool is_level = front.points[t[1]].z() == z && front.points[t[2]].z() == z;
  return is_level ? Region::ground : Region::relief;
}

// The front alone, the corner of its box at `corner`.
Solid placed_front(const Front& front, const Box& box, const Vec3& corner) {
  Solid solid;
  solid.points.reserve(front.points.size() + 8);
  // Subtracting before adding keeps the box exact.
  for (const Vec3& p : front.points) solid.points.push_back((p - box.min) + corner);
  solid.triangles = front.triangles;
  for (const Triangle& t : front.triangles) solid.regions.push_back(region_of(front, t));
  solid.colours = front.colours;
  solid.shift = corner - box.min;
  solid.ground_mm = front.ground_mm + solid.shift.z();
  return solid;
}

Top flat_top(const Front& front, const PlateOptions& options, double spacing) {
  const Box box = used_box(front.points, front.triangles);
  if (options.outline == Outline::none) return {placed_front(front, box, Vec3::Zero()), {}, spacing};
  const Ground ground = ground_around(front, box, options);
  Top top{placed_front(front, box, {ground.corner.x(), ground.corner.y(), 0}), {}, spacing};
  top.outline = add_ground(top.solid, front, ground, {options.rim, spacing});
  fill_colours(top.solid);
  return top;
}

// The polygon within which there is no rim; none without ground.
std::vector<Vec2> foot_of(const Front& front, const PlateOptions& options) {
  if (options.outline == Outline::none) return {};
  return foot_polygon(ground_around(front, used_box(front.points, front.triangles), options), options.rim);
}

// The plate's outline in the front's coordinates; without ground, points as far out.
std::vector<Vec2> outline_of(const Front& front, const PlateOptions& options) {
  std::vector<Vec2> outline;
  if (options.outline == Outline::none) {
    for (const Triangle& t : front.triangles)
      for (const Index i : t) outline.push_back(front.points[i].head<2>());
    return outline;
  }
  const Box box = used_box(front.points, front.triangles);
  const Ground ground = ground_around(front, box, options);
  for (const Vec2& p : ground.outline) outline.push_back(p - ground.corner + box.min.head<2>());
  return outline;
}

// A surface that the top is to follow, in the front's coordinates.
struct Course {
  Bend bend;
  // Over the plane; of a wrap what bends like it, so that triangles good for one are good for the other.
  std::function<double(const Vec2&)> height;
  bool is_lifted = false;  // to that height
};

Course course_on(const Base& base) {
  Course course;
  course.is_lifted = true;
  course.height = [&base](const Vec2& p) { return base.height(p); };
  course.bend.at = [&base](const Vec3& p) { return Vec3(p.x(), p.y(), p.z() + base.height(p.head<2>())); };
  course.bend.corner_between = [&base](const Vec3& p, const Vec3& q) {
    return base.ridge_between(p.head<2>(), q.head<2>());
  };
  course.bend.feature_mm = base.feature_mm();
  return course;
}

Course course_around(const Wrap& wrap, double ground_z) {
  Course course;
  course.height = [wrap](const Vec2& p) { return wrap.sag(p); };
  course.bend.at = [wrap, ground_z](const Vec3& p) { return wrap.at(p.head<2>(), p.z() - ground_z); };
  course.bend.feature_mm = wrap.reach_mm();
  return course;
}

Course moved(Course course, const Vec3& shift) {
  course.height = [height = course.height, shift](const Vec2& p) { return height(p + shift.head<2>()); };
  course.bend.at = [at = course.bend.at, shift](const Vec3& p) { return Vec3(at(p + shift) - shift); };
  if (course.bend.corner_between)
    course.bend.corner_between = [between = course.bend.corner_between, shift](const Vec3& p, const Vec3& q) {
      return between(p + shift, q + shift);
    };
  return course;
}

void lift(std::vector<Vec3>& points, const Course& course, double sign) {
  parallel_for(points.size(),
               [&](std::size_t i) { points[i].z() += sign * course.height(points[i].head<2>()); });
}

// The points and triangles of a top that is a height field within its outline.
Front as_front(const Top& top) {
  std::vector<Index> place(top.solid.points.size(), no_index);
  Front front{{}, top.solid.triangles, top.outline};
  for (const Triangle& t : front.triangles)
    for (const Index i : t) place[i] = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == no_index) continue;
    place[i] = static_cast<Index>(front.points.size());
    front.points.push_back(top.solid.points[i]);
    if (!top.solid.colours.empty()) front.colours.push_back(top.solid.colours[i]);
  }
  for (Triangle& t : front.triangles)
    for (Index& i : t) i = place[i];
  for (Index& i : front.hull) i = place[i];
  return front;
}

// Fewer triangles for a top that has been lifted.
Result<void> simplify_top(Top& top, const SimplifyOptions& options) {
  Result<SimplerFront> simpler = simplify(as_front(top), options);
  if (!simpler) return std::unexpected(simpler.error());
  top.solid.points = std::move(simpler->front.points);
  top.solid.triangles = std::move(simpler->front.triangles);
  top.solid.colours = std::move(simpler->front.colours);
  top.solid.error_mm += simpler->error_mm;
  top.outline = std::move(simpler->front.hull);
  return {};
}

// What the triangles of a simpler top show: what lies at the height of the ground is ground.
void find_regions(Solid& top, std::span<const Vec2> foot, double ground_z, double tolerance_mm) {
  top.regions.resize(top.triangles.size());
  parallel_for(top.triangles.size(), [&](std::size_t i) {
    const Triangle& t = top.triangles[i];
    const auto is_low = [&](Index p) { return std::abs(top.points[p].z() - ground_z) <= tolerance_mm; };
    const Vec3 sum = top.points[t[0]] + top.points[t[1]] + top.points[t[2]];
    const bool is_on_rim = !is_within(sum.head<2>() / 3, foot);
    top.regions[i] = is_on_rim                        ? Region::bevel
                     : std::ranges::all_of(t, is_low) ? Region::ground
                                                      : Region::relief;
  });
}

// The flat top, made to follow the course, given in its own coordinates.
Result<void> follow(Top& top, const Course& course, const PlateOptions& options, std::span<const Vec2> foot) {
  // What is to be bent as a whole is refined as a whole, by wrap_plate().
  if (course.is_lifted)
    top.solid.error_mm = refine(top.solid, top.outline, course.bend, options.tolerance_mm);
  const bool is_simplified = options.simplify_mm > 0 && !top.outline.empty();
  const double ground_z = top.solid.ground_mm;
  if (is_simplified || course.is_lifted) lift(top.solid.points, course, 1);
  if (!is_simplified) return {};
  if (auto good = simplify_top(top, {options.simplify_mm, options.max_slope}); !good) return good;
  lift(top.solid.points, course, -1);
  find_regions(top.solid, foot, ground_z, options.simplify_mm);
  if (course.is_lifted) lift(top.solid.points, course, 1);
  return {};
}

}  // namespace

Box used_box(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  Box box;
  for (const Triangle& t : triangles)
    for (const Index i : t) box.extend(points[i]);
  return box;
}

void fill_colours(Solid& solid) {
  if (!solid.colours.empty()) solid.colours.resize(solid.points.size(), plate_colour);
}

Result<Base> base_of(const Front& front, const PlateOptions& options) {
  if (options.base.kind == BaseKind::plane) return Base();
  return Base::over(options.base, outline_of(front, options));
}

Result<Top> make_top(const Front& front, const Base& base, const PlateOptions& options) {
  const double none = std::numeric_limits<double>::infinity();
  const bool is_wrapped = options.wrap.kind != WrapKind::none;
  if (base.is_plane() && !is_wrapped) return flat_top(front, options, none);
  const std::vector<Vec2> outline = outline_of(front, options);
  Course course = course_on(base);
  if (is_wrapped) {
    const Result<Wrap> wrap = Wrap::around(options.wrap, outline);
    if (!wrap) return std::unexpected(wrap.error());
    course = course_around(*wrap, front.ground_mm);
  }
  const double spacing = options.outline == Outline::none
                             ? none
                             : ground_spacing(course.bend, outline, front.ground_mm, options.tolerance_mm);
  Top top = flat_top(front, options, spacing);
  const std::vector<Vec2> foot = foot_of(front, options);
  if (auto good = follow(top, moved(std::move(course), -top.solid.shift), options, foot); !good)
    return std::unexpected(good.error());
  return top;
}

}  // namespace relievo
