#include "picture/live_plate.h"

#include <algorithm>
#include <cmath>

#include "picture/plate_mesh.h"
#include "plate/front/silhouette.h"
#include "relievo/core/parallel.h"
#include "relievo/plate/forms.h"

namespace relievo {
namespace {

// Returns a front with these heights of the surface's points, mirrored if the plate is.
HeightFieldMesh front_of(const Surface& surface, const PlateOptions& plate, double mm_per_unit,
                         std::span<const double> heights) {
  HeightFieldMesh front{std::vector<Vec3>(surface.points.size()), surface.triangulation.triangles,
                        surface.triangulation.hull};
  for (std::size_t i = 0; i < front.points.size(); ++i)
    front.points[i] << mm_per_unit * surface.points[i].head<2>(), heights[i];
  if (plate.is_die) return as_die(std::move(front));
  return plate.is_mirrored ? mirrored(std::move(front)) : front;
}

// Returns heights that differ from point to point inside the relief, and are 0 around it. Without them
// make_plate() would take the relief for ground.
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

// Returns the numbers that the points of a part of a front have in the whole front. The points of both are in the same
// order.
std::vector<Index> numbers_in(const HeightFieldMesh& whole, const HeightFieldMesh& part) {
  std::vector<Index> numbers;
  for (Index i = 0; i < whole.points.size() && numbers.size() < part.points.size(); ++i)
    if (whole.points[i] == part.points[numbers.size()]) numbers.push_back(i);
  return numbers;
}

// Replaces the triangles of the relief, which make_plate() may have divided to follow the base, by those of the front.
void restore_relief(Solid& solid, const HeightFieldMesh& front) {
  std::vector<Triangle> triangles;
  for (const Triangle& t : front.triangles) {
    const double z = front.points[t[0]].z();
    if (front.points[t[1]].z() != z || front.points[t[2]].z() != z) triangles.push_back(t);
  }
  std::vector<Region> regions(triangles.size(), Region::relief);
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const bool is_front = t < solid.front_triangles;
    if (is_front && solid.regions[t] == Region::relief) continue;
    triangles.push_back(solid.triangles[t]);
    if (is_front) regions.push_back(solid.regions[t]);
  }
  solid.triangles = std::move(triangles);
  solid.front_triangles = regions.size();
  solid.regions = std::move(regions);
}

// Returns the number of points of the front, behind which those of the bottom stand.
std::size_t front_points(const Solid& solid) {
  Index last = 0;
  for (std::size_t t = 0; t < solid.front_triangles; ++t)
    last = std::max(last, std::ranges::max(solid.triangles[t]));
  return last + std::size_t{1};
}

// Returns the options with a rim of height 1, in which plates that differ in the rim's height agree.
PlateOptions of_unit_rim(PlateOptions plate) {
  plate.rim.height_mm = 1;
  plate.rim.bevel_mm = 0;
  return plate;
}

}  // namespace

Result<LivePlate> LivePlate::make(const Surface& surface, const PlateOptions& plate, double mm_per_unit) {
  const bool is_curved = plate.base.kind != BaseKind::plane, has_ground = plate.outline != Outline::none;
  const bool is_wrapped = plate.wrap.kind != WrapKind::none,
             is_level = has_ground && !is_curved && !is_wrapped;
  const std::vector<double> heights =
      is_level ? std::vector<double>(surface.points.size()) : uneven_heights(surface);
  HeightFieldMesh whole = front_of(surface, plate, mm_per_unit, heights);
  if (!has_ground) whole.is_relief = surface.boundary.is_inside;
  const HeightFieldMesh front = has_ground ? whole : relief_alone(whole);
  RELIEVO_TRY(const Base base, plate_base(whole, plate));
  RELIEVO_TRY(Solid solid, make_plate(whole, plate));
  if (is_curved) restore_relief(solid, front);
  LivePlate made;
  made.options_ = plate;
  made.mm_per_unit_ = mm_per_unit;
  made.parts_ = is_level ? parts_of_frames(solid, surface) : plate_parts(solid);
  made.relief_ = numbers_in(whole, front);
  const Vec2 middle = made.find_places(solid);
  made.relief_middle_ = Box::of(whole.points).centre().head<2>() + solid.shift.head<2>() - middle;
  made.find_base(solid, front, base);
  made.triangles_ = solid.triangles;
  if (!is_wrapped) return made;
  RELIEVO_TRY(const Wrap wrap, plate_wrap(solid, plate));
  made.find_wrap(std::move(solid), wrap);
  return made;
}

// Finds where the points of front and bottom lie from the middle of the plate. Returns the middle in the solid's
// coordinates.
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

// Finds the base under all points of the front, and how far they rise above it with the rim.
void LivePlate::find_base(const Solid& solid, const HeightFieldMesh& front, const Base& base) {
  constexpr double step_mm = .01;  // between the two places whose heights give a slope
  const std::size_t count = places_.size();
  const auto place = [&](std::size_t i) -> Vec2 { return (solid.points[i] - solid.shift).head<2>(); };
  rise_.assign(count - relief_.size(), 0.F);  // stays 0 for points that no triangle uses
  for (std::size_t t = 0; t < solid.front_triangles && options_.rim.width_mm > 0; ++t)
    for (const Index i : solid.triangles[t]) {
      if (i < relief_.size()) continue;
      const double above_mm = solid.points[i].z() - solid.ground_mm - base.height(place(i));
      rise_[i - relief_.size()] = static_cast<float>(above_mm / options_.rim.height_mm);
    }
  if (base.is_plane()) return;
  base_.resize(count);
  slopes_.resize(relief_.size());
  parallel_for(count, [&](std::size_t i) { base_[i] = static_cast<float>(base.height(place(i))); });
  parallel_for(relief_.size(), [&](std::size_t i) {
    const Vec2 at = front.points[i].head<2>();
    for (int k = 0; k < 2; ++k) {
      const Vec2 half = step_mm / 2 * Vec2::Unit(k);
      slopes_[i][k] = static_cast<float>((base.height(at + half) - base.height(at - half)) / step_mm);
    }
  });
}

// Prepares the points for bending, and shades ground and rim as they are when they are bent.
void LivePlate::find_wrap(Solid solid, const Wrap& wrap) {
  std::vector<Vec2> places = in_plane(solid.points);
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    const double z = i < relief_.size() ? 0 : solid.points[i].z() - solid.ground_mm;
    solid.points[i] = wrap.at(places[i], z);
  }
  solid.ground_mm = std::numeric_limits<double>::infinity();  // no part of the ground stays level
  parts_ = plate_parts(solid);
  bent_.emplace(wrap, places);
}

// Returns the normal of the relief on its base from the normal of the frame: the slopes of both are added.
Vec3f LivePlate::normal_on_base(const Vec3f& normal, float stretch, const Vec2f& slope) const {
  Vec2f xy = stretch * normal.head<2>();
  if (options_.is_mirrored || options_.is_die) xy.x() = -xy.x();
  if (options_.is_die) xy = -xy;
  Vec3f sum;
  sum << xy - normal.z() * slope, normal.z();
  return sum.normalized();
}

bool LivePlate::serves(const PlateOptions& plate, double mm_per_unit, bool is_exact) const {
  if (mm_per_unit != mm_per_unit_) return false;
  return plate == options_ || (!is_exact && of_unit_rim(plate) == of_unit_rim(options_));
}

DrawnBody LivePlate::body(const Shown& shown, double rim_mm) {
  const float scale = static_cast<float>(options_.is_die ? -mm_per_unit_ : mm_per_unit_) * shown.stretch;
  const bool is_as_framed = slopes_.empty() && !options_.is_mirrored && !options_.is_die && !bent_;
  parallel_for(relief_.size(), [&](std::size_t i) {
    const Vec3f& normal = shown.normals[relief_[i]];
    heights_[i] = scale * shown.heights[relief_[i]];
    normals_[i] = is_as_framed ? normal
                               : normal_on_base(normal, shown.stretch,
                                                slopes_.empty() ? Vec2f(Vec2f::Zero()) : slopes_[i]);
  });
  for (std::size_t i = 0; i < rise_.size(); ++i)
    heights_[relief_.size() + i] = static_cast<float>(rim_mm) * rise_[i];
  for (std::size_t i = 0; i < base_.size(); ++i) heights_[i] += base_[i];
  DrawnBody body{triangles_, parts_, places_, 1, heights_, 1, normals_, is_as_framed ? shown.stretch : 1};
  if (bent_) {
    bend(body);
    return body;
  }
  const auto [lowest, highest] = std::ranges::minmax(heights_);
  body.front.extend({-half_.x(), -half_.y(), static_cast<double>(lowest)});
  body.front.extend({half_.x(), half_.y(), static_cast<double>(highest)});
  body.is_height_field = true;
  body.is_rectangle = options_.outline == Outline::rectangle;
  for (const Vec2& p : below_) body.box_corners.push_back({p.x(), p.y(), lowest - options_.thickness_mm});
  box_ = body.front;
  box_.extend({0, 0, lowest - options_.thickness_mm});
  return body;
}

// Bends a body whose heights are those on the flat plate.
void LivePlate::bend(DrawnBody& body) {
  const float bottom = std::ranges::min(heights_) - static_cast<float>(options_.thickness_mm);
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

}  // namespace relievo
