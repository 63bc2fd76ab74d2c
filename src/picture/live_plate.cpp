#include "picture/live_plate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "geometry/neighbours.h"
#include "picture/plate_mesh.h"
#include "plate/plate_surface.h"
#include "relievo/core/parallel.h"
#include "relievo/plate/forms.h"

namespace relievo {
namespace {

// Returns the front of a plate. `heights` are the heights of the surface's points. The front is
// mirrored if the plate is mirrored.
HeightFieldMesh front_of(const Surface& surface, const PlateOptions& plate, double mm_per_unit,
                         std::span<const double> heights) {
  HeightFieldMesh front{std::vector<Vec3>(surface.points.size()), surface.triangulation.triangles,
                        surface.triangulation.hull};
  for (std::size_t i = 0; i < front.points.size(); ++i)
    front.points[i] << mm_per_unit * surface.points[i].head<2>(), heights[i];
  if (plate.is_die) return as_die(std::move(front));
  return plate.is_mirrored ? mirrored(std::move(front)) : front;
}

// Returns heights that are 0 around the relief, and differ from point to point inside it. Without such
// heights make_plate() would take the relief for ground.
std::vector<double> uneven_heights(const Surface& surface) {
  std::vector<double> heights(surface.points.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
    heights[i] = 1 + static_cast<double>(i) / static_cast<double>(heights.size());
  for (const Index i : surface.triangulation.hull) heights[i] = 0;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
    if (!surface.boundary.is_inside[t])
      for (const Index i : surface.triangulation.triangles[t]) heights[i] = 0;
  return heights;
}

// Returns the points of the front that the solid contains, in the solid's order. make_plate() moves all points by the
// same vector, and leaves some out if there is no ground.
std::vector<Index> points_kept(const HeightFieldMesh& front, const Solid& solid) {
  constexpr double rounding_mm = 1e-9;
  std::vector<Index> kept;
  for (Index i = 0; i < front.points.size() && kept.size() < solid.points.size(); ++i) {
    const Vec2 apart = (solid.points[kept.size()] - solid.shift - front.points[i]).head<2>();
    if (apart.cwiseAbs().maxCoeff() < rounding_mm) kept.push_back(i);
  }
  return kept;
}

// Returns the number of points of the front. They come first in the solid's list; the points of the bottom follow.
std::size_t front_points(const Solid& solid) {
  Index last = 0;
  for (std::size_t t = 0; t < solid.front_triangles; ++t)
    last = std::max(last, std::ranges::max(solid.triangles[t]));
  return last + std::size_t{1};
}

// Returns the options with a rim of height 1 and no bevel. So options that differ only in the rim's
// height become equal.
PlateOptions of_unit_rim(PlateOptions plate) {
  plate.rim.height_mm = 1;
  plate.rim.bevel_mm = 0;
  return plate;
}

}  // namespace

Result<LivePlate> LivePlate::make(const Surface& surface, const PlateOptions& plate, double mm_per_unit) {
  const bool is_curved = plate.base.kind != BaseKind::plane, is_wrapped = plate.wrap.kind != WrapKind::none;
  const bool is_level = plate.outline != Outline::none && !is_curved && !is_wrapped;
  HeightFieldMesh front =
      front_of(surface, plate, mm_per_unit,
               is_level ? std::vector<double>(surface.points.size()) : uneven_heights(surface));
  if (plate.outline == Outline::none) front.is_relief = surface.boundary.is_inside;
  RELIEVO_TRY(const Base base, plate_base(front, plate));
  RELIEVO_TRY(Solid solid, make_plate(front, plate));
  LivePlate made;
  made.options_ = plate;
  made.mm_per_unit_ = mm_per_unit;
  made.parts_ = is_level ? parts_of_frames(solid, surface) : plate_parts(solid);
  made.relief_ = points_kept(front, solid);
  const Vec2 middle = made.find_places(solid);
  made.relief_middle_ = Box::of(front.points).centre().head<2>() + solid.shift.head<2>() - middle;
  if (is_curved) made.find_added_points(solid);
  made.find_base(solid, base);
  made.triangles_ = solid.triangles;
  if (!is_wrapped) return made;
  RELIEVO_TRY(const Wrap wrap, plate_wrap(solid, plate));
  RELIEVO_CHECK(check_closed(plate, wrap));
  made.find_wrap(std::move(solid), wrap);
  return made;
}

// Computes the positions of the points of front and bottom relative to the middle of the plate. Returns the
// middle in the solid's coordinates.
Vec2 LivePlate::find_places(const Solid& solid) {
  const Box box = Box::of(solid.points);
  const Vec2 middle = box.centre().head<2>();
  const std::size_t count = front_points(solid);
  for (std::size_t i = 0; i < solid.points.size(); ++i)
    (i < count ? places_ : below_).push_back(solid.points[i].head<2>() - middle);
  heights_.resize(count);
  normals_.assign(count, Vec3f::Zero());
  half_ = box.size().head<2>() / 2;
  return middle;
}

// Finds the points that make_plate() has added to the relief, because it divided triangles to follow the base.
void LivePlate::find_added_points(const Solid& solid) {
  std::vector<std::uint8_t> is_added(places_.size(), 0);
  for (const bool is_relief : {true, false})  // points on a common border count as ground
    for (std::size_t t = 0; t < solid.front_triangles; ++t)
      if ((solid.regions[t] == Region::relief) == is_relief)
        for (const Index i : solid.triangles[t]) is_added[i] = is_relief;
  std::optional<KdTree<Vec2>> tree;
  for (Index i = static_cast<Index>(relief_.size()); i < is_added.size(); ++i) {
    if (!is_added[i]) continue;
    if (!tree) tree.emplace(std::span(places_).first(relief_.size()));
    AddedPoint added{i, {}, {}};
    std::array<double, 3> distances_sq;
    tree->nearest(places_[i], 3, added.from.data(), distances_sq.data());
    // An added point lies between its two nearest points. Weights that fall with the fourth power of the
    // distance give these two nearly all of the weight.
    for (std::size_t k = 0; k < 3; ++k)
      added.share[k] = static_cast<float>(1 / (distances_sq[k] * distances_sq[k] + 1e-12));
    const float sum = added.share[0] + added.share[1] + added.share[2];
    for (float& share : added.share) share /= sum;
    added_.push_back(added);
  }
}

// Computes the base under all points of the front, and the heights of the rim's points above the base.
void LivePlate::find_base(const Solid& solid, const Base& base) {
  constexpr double step_mm = .01;  // distance between the two positions whose heights give a slope
  const std::size_t count = places_.size();
  const auto place = [&](std::size_t i) -> Vec2 { return (solid.points[i] - solid.shift).head<2>(); };
  rise_.assign(count - relief_.size(), 0.F);
  for (std::size_t t = 0; t < solid.front_triangles && options_.rim.width_mm > 0; ++t)
    for (const Index i : solid.triangles[t]) {
      if (i < relief_.size() || solid.regions[t] == Region::relief) continue;
      const double above_mm = solid.points[i].z() - solid.ground_mm - base.height(place(i));
      rise_[i - relief_.size()] = static_cast<float>(above_mm / options_.rim.height_mm);
    }
  if (base.is_plane()) return;
  base_.resize(count);
  slopes_.resize(count);
  parallel_for(count, [&](std::size_t i) {
    const Vec2 at = place(i);
    base_[i] = static_cast<float>(base.height(at));
    for (int k = 0; k < 2; ++k) {
      const Vec2 half = step_mm / 2 * Vec2::Unit(k);
      slopes_[i][k] = static_cast<float>((base.height(at + half) - base.height(at - half)) / step_mm);
    }
  });
}

// Prepares the points for bending, and computes the normals of ground and rim from the bent solid.
void LivePlate::find_wrap(Solid solid, const Wrap& wrap) {
  std::vector<Vec2> places = in_plane(solid.points);
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    const double z = i < relief_.size() ? 0 : solid.points[i].z() - solid.ground_mm;
    solid.points[i] = wrap.at(places[i], z);
  }
  solid.ground_mm = std::numeric_limits<double>::infinity();  // so that no part of the ground counts as level
  parts_ = plate_parts(solid);
  bent_.emplace(wrap, places);
}

// Returns the normal of the relief at a point of the front. The slopes of the result are the slopes of the frame's
// normal plus those of the base.
Vec3f LivePlate::normal_on_base(std::size_t i, const Vec3f& normal, float stretch) const {
  Vec2f xy = stretch * normal.head<2>();
  if (options_.is_mirrored || options_.is_die) xy.x() = -xy.x();
  if (options_.is_die) xy = -xy;
  if (!slopes_.empty()) xy -= normal.z() * slopes_[i];
  Vec3f sum;
  sum << xy, normal.z();
  return sum.normalized();
}

bool LivePlate::serves(const PlateOptions& plate, double mm_per_unit, bool is_exact) const {
  if (mm_per_unit != mm_per_unit_) return false;
  return plate == options_ || (!is_exact && of_unit_rim(plate) == of_unit_rim(options_));
}

Result<DrawnBody> LivePlate::body(const Shown& shown, double rim_mm) {
  const float scale = static_cast<float>(options_.is_die ? -mm_per_unit_ : mm_per_unit_) * shown.stretch;
  const bool is_as_framed = slopes_.empty() && !options_.is_mirrored && !options_.is_die && !bent_;
  const auto set = [&](std::size_t i, float height, const Vec3f& normal) {
    heights_[i] = scale * height;
    normals_[i] = is_as_framed ? normal : normal_on_base(i, normal, shown.stretch);
  };
  for (std::size_t i = 0; i < rise_.size(); ++i)
    heights_[relief_.size() + i] = static_cast<float>(rim_mm) * rise_[i];
  parallel_for(relief_.size(),
               [&](std::size_t i) { set(i, shown.heights[relief_[i]], shown.normals[relief_[i]]); });
  for (const AddedPoint& p : added_) {
    const auto mean = [&](const auto& values) -> std::decay_t<decltype(values[0])> {
      const auto at = [&](std::size_t k) { return values[relief_[p.from[k]]]; };
      return p.share[0] * at(0) + p.share[1] * at(1) + p.share[2] * at(2);
    };
    set(p.point, mean(shown.heights), mean(shown.normals));
  }
  for (std::size_t i = 0; i < base_.size(); ++i) heights_[i] += base_[i];
  DrawnBody body{triangles_, parts_, places_, 1, heights_, 1, normals_, is_as_framed ? shown.stretch : 1};
  const auto [lowest, highest] = std::ranges::minmax(heights_);
  if (bent_) {
    RELIEVO_CHECK(check_room(bent_->wrap(), options_.thickness_mm - static_cast<double>(lowest),
                             static_cast<double>(highest)));
    bend(body, lowest - static_cast<float>(options_.thickness_mm));
    return body;
  }
  body.front.extend({-half_.x(), -half_.y(), static_cast<double>(lowest)});
  body.front.extend({half_.x(), half_.y(), static_cast<double>(highest)});
  body.is_height_field = true;
  body.is_rectangle = options_.outline == Outline::rectangle;
  for (const Vec2& p : below_) body.box_corners.push_back({p.x(), p.y(), lowest - options_.thickness_mm});
  box_ = body.front;
  box_.extend({0, 0, lowest - options_.thickness_mm});
  return body;
}

// Bends a body. The body has the heights of the flat plate; `bottom` is the height of the flat plate's bottom.
void LivePlate::bend(DrawnBody& body, float bottom) {
  std::vector<Vec3f> points(places_.size() + below_.size());
  parallel_for(points.size(), [&](std::size_t i) {
    const float height = i < heights_.size() ? heights_[i] : bottom;
    points[i] = bent_->at(i, height);
    if (i < relief_.size()) normals_[i] = bent_->normal(i, height, normals_[i]);
  });
  Box box;
  for (const Vec3f& p : points) box.extend(p.cast<double>());
  const Vec3 origin(box.centre().x(), box.centre().y(), box.min.z() - static_cast<double>(bottom));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i].cast<double>() - origin;
    if (i >= places_.size()) {
      body.box_corners.push_back(p);
      continue;
    }
    places_[i] = p.head<2>();
    heights_[i] = static_cast<float>(p.z());
    body.front.extend(p);
  }
  box_ = {box.min - origin, box.max - origin};
}

Vec3 LivePlate::size_around_ground() const {
  return 2 * box_.min.cwiseAbs().cwiseMax(box_.max.cwiseAbs());
}

PlacedRelief LivePlate::placed() const {
  return {box_.size(), relief_middle_};
}

BentPoints::BentPoints(const Wrap& wrap, std::span<const Vec2> places) : wrap_(wrap), points_(places.size()) {
  constexpr double step_mm = .01;  // distance between the two positions from which a derivative is computed
  const auto out_at = [&](const Vec2& p) -> Vec3 { return wrap.at(p, 1) - wrap.at(p, 0); };
  parallel_for(places.size(), [&](std::size_t i) {
    const Vec2 p = places[i], x(step_mm / 2, 0), y(0, step_mm / 2);
    points_[i] = {wrap.at(p, 0).cast<float>(),
                  out_at(p).cast<float>(),
                  ((wrap.at(p + x, 0) - wrap.at(p - x, 0)) / step_mm).cast<float>(),
                  ((wrap.at(p + y, 0) - wrap.at(p - y, 0)) / step_mm).cast<float>(),
                  ((out_at(p + x) - out_at(p - x)) / step_mm).cast<float>(),
                  ((out_at(p + y) - out_at(p - y)) / step_mm).cast<float>()};
  });
}

// The normal is perpendicular to the derivatives of the relief's position with respect to x and y. Both
// derivatives are multiplied by the z of the flat normal. The product of this z and a slope of the flat
// relief is minus the x or y of the flat normal, so no division is needed.
Vec3f BentPoints::normal(std::size_t i, float height_mm, const Vec3f& flat) const {
  const Point& p = points_[i];
  const Vec3f by_x = flat.z() * (p.at_by_x + height_mm * p.out_by_x) - flat.x() * p.out;
  const Vec3f by_y = flat.z() * (p.at_by_y + height_mm * p.out_by_y) - flat.y() * p.out;
  return by_x.cross(by_y).normalized();
}

}  // namespace relievo
