#include "picture/live_plate.h"

#include <algorithm>
#include <cmath>

#include "picture/plate_mesh.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

HeightFieldMesh level_front(const Surface& surface, double mm_per_unit) {
  HeightFieldMesh front{std::vector<Vec3>(surface.points.size()), surface.triangulation.triangles,
                        surface.triangulation.hull};
  for (std::size_t i = 0; i < front.points.size(); ++i)
    front.points[i] << mm_per_unit * surface.points[i].head<2>(), 0;
  return front;
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
  RELIEVO_TRY(Solid solid, make_plate(level_front(surface, mm_per_unit), plate));
  LivePlate made;
  made.options_ = plate;
  made.mm_per_unit_ = mm_per_unit;
  made.parts_ = parts_of_frames(solid, surface);
  made.relief_points_ = surface.points.size();
  Box box;
  for (const Vec3& p : solid.points) box.extend(p);
  const Vec2 middle = box.centre().head<2>();
  const std::size_t front = front_points(solid);
  for (std::size_t i = 0; i < solid.points.size(); ++i)
    (i < front ? made.places_ : made.below_).push_back(solid.points[i].head<2>() - middle);
  for (std::size_t i = made.relief_points_; i < front; ++i) {
    const double rise = (solid.points[i].z() - solid.ground_mm) / plate.rim.height_mm;
    made.rise_.push_back(plate.rim.width_mm > 0 ? static_cast<float>(rise) : 0);
  }
  made.half_ = box.size().head<2>() / 2;
  made.relief_middle_ =
      mm_per_unit * Box::of(surface.points).centre().head<2>() + solid.shift.head<2>() - middle;
  made.triangles_ = std::move(solid.triangles);
  made.heights_.resize(front);
  made.normals_.assign(front, Vec3f::Zero());
  return made;
}

bool LivePlate::serves(const PlateOptions& plate, double mm_per_unit, bool is_exact) const {
  if (mm_per_unit != mm_per_unit_) return false;
  return plate == options_ || (!is_exact && of_unit_rim(plate) == of_unit_rim(options_));
}

DrawnBody LivePlate::body(const Shown& shown, double rim_mm) {
  const float scale = static_cast<float>(mm_per_unit_) * shown.stretch;
  parallel_for(relief_points_, [&](std::size_t i) {
    heights_[i] = scale * shown.heights[i];
    normals_[i] = shown.normals[i];
  });
  for (std::size_t i = 0; i < rise_.size(); ++i)
    heights_[relief_points_ + i] = static_cast<float>(rim_mm) * rise_[i];
  const auto [lowest, highest] = std::ranges::minmax(heights_);
  front_ = {};
  front_.extend({-half_.x(), -half_.y(), static_cast<double>(lowest)});
  front_.extend({half_.x(), half_.y(), static_cast<double>(highest)});
  DrawnBody body{triangles_, parts_, places_, 1, heights_, 1, normals_, shown.stretch};
  body.front = front_;
  body.is_height_field = true;
  body.is_rectangle = options_.outline == Outline::rectangle;
  for (const Vec2& p : below_)
    body.box_corners.push_back({p.x(), p.y(), front_.min.z() - options_.thickness_mm});
  return body;
}

Vec3 LivePlate::size_around_ground() const {
  const double below = options_.thickness_mm - front_.min.z();
  return 2 * Vec3(half_.x(), half_.y(), std::max(below, front_.max.z()));
}

PlacedRelief LivePlate::placed() const {
  return {{2 * half_.x(), 2 * half_.y(), options_.thickness_mm + front_.size().z()}, relief_middle_};
}

}  // namespace relievo
