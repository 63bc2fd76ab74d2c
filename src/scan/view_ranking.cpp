// Ranks the sides of a model. Declared in view.h. For the choice of the constants see
// docs/decisions/best-view.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "relievo/core/text.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/view.h"
#include "scan/coarse_visibility.h"

namespace relievo {
namespace {

using Sides = std::array<ViewGuess, 6>;

constexpr double front_weight = 1.6;   // factor for the score of the side that is the front in most files
constexpr double beside_scan = .25;    // factor for the scores of sides perpendicular to a scan's direction
constexpr double perhaps_hollow = .5;  // factor for the score of a side with the shape of a hollow back

// Formats a direction for parse_view().
std::string text_of(const Vec3& direction) {
  std::string text;
  for (const double x : direction) {
    const double rounded = std::round(1e4 * x) / 1e4;
    text += cat(text.empty() ? "" : ",", rounded == 0 ? 0. : rounded);
  }
  return text;
}

ViewGuess guess_of(const Side& side) {
  const View view = view_towards(side.towards_viewer, side.up).value_or(View{});
  const auto is_it = [&](const View& other) { return other.R_view_model.isApprox(view.R_view_model, 1e-6); };
  for (const char* name : {"front", "back", "left", "right", "bottom", "top"}) {
    const std::string up = text_of(side.up);
    if (is_it(parse_view(name).value_or(View{}))) return {name, ""};
    if (is_it(parse_view(name, up).value_or(View{}))) return {name, up};
  }
  return {text_of(side.towards_viewer), text_of(side.up)};
}

// Returns the six sides of a model with this front. Opposite sides are next to each other.
Sides sides_around(const Side& front) {
  const auto& [towards, up] = front;
  const Vec3 right = up.cross(towards);
  return {guess_of(front),       guess_of({-towards, up}), guess_of({-right, up}),
          guess_of({right, up}), guess_of({-up, towards}), guess_of({up, -towards})};
}

// The foot of a model consists of its lowest points, where up is the positive axis or, if `sign` is -1, the
// negative axis. Returns the area of the foot's bounding box as a share of the area of the model's box. Both
// areas are measured perpendicular to the axis.
double foot_along(const Cloud& cloud, const Box& box, int axis, int sign) {
  constexpr double foot = .03;  // share of the height; points within it belong to the foot
  const double lowest = sign > 0 ? box.min[axis] : -box.max[axis], least = lowest + foot * box.size()[axis];
  Box low;
  for (const Vec3& p : cloud.points)
    if (sign * p[axis] <= least) low.extend(p);
  double share = 1;
  for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
    share *= box.size()[other] > 0 ? low.size()[other] / box.size()[other] : 1;
  return share;
}

// Returns the front of an upright model. It depends on the side on which the model has its foot.
// - Usually the foot is at the least y. Then the front is +Z, with Y upwards.
// - If the foot at the least z is much broader than that at the least y, the front is -Y, with Z upwards.
// - If the foot at the largest y is much broader, the front is -Z, with -Y upwards, as in the coordinates of
// cameras.
Side front_of(const Cloud& cloud) {
  constexpr double wide = .3, wider = 3;
  const Box box = bounds(cloud);
  const double usual = foot_along(cloud, box, 1, 1), on_z = foot_along(cloud, box, 2, 1),
               on_minus_y = foot_along(cloud, box, 1, -1);
  if (std::max(on_z, on_minus_y) <= std::max(wide, wider * usual)) return {Vec3::UnitZ(), Vec3::UnitY()};
  if (on_z >= on_minus_y) return {-Vec3::UnitY(), Vec3::UnitZ()};
  return {-Vec3::UnitZ(), -Vec3::UnitY()};
}

std::vector<CoarseVisibility> seen_from(const Sides& sides, const Cloud& cloud, NormalSigns signs) {
  std::vector<View> views;
  for (const ViewGuess& side : sides) views.push_back(parse_view(side.name, side.up).value_or(View{}));
  return coarse_visibility(cloud, views, signs);
}

// Returns a factor for the score of a side. It is small if the side is a hollow back, which is recognised by the signs
// of the normals or, without signs, by the shape.
double outside_share(const CoarseVisibility& seen, bool has_signs) {
  if (has_signs) return seen.facing_share;
  return seen.outside < 0 ? perhaps_hollow : 1;
}

}  // namespace

std::array<ViewGuess, 6> rank_views(const Cloud& all) {
  Cloud cloud = erase_points(all, outliers(all));
  const bool has_signs = cloud.has_normals();
  if (!has_signs) {
    cloud = without_repeated_points(std::move(cloud));
    estimate_normals(cloud);
  }
  NormalSigns signs = has_signs ? NormalSigns::outward : NormalSigns::unknown;
  if (has_signs && normals_point_inward(cloud)) signs = NormalSigns::inward;
  const std::optional<Side> scanned = scanned_side(cloud, signs);
  Sides sides = sides_around(scanned ? *scanned : front_of(cloud));
  const std::vector<CoarseVisibility> seen = seen_from(sides, cloud, signs);
  for (std::size_t i = 0; i < 6; ++i) {
    const double of_scan = i == 0 ? 1 : i == 1 ? 0 : beside_scan;
    const double of_model = (i == 0 ? front_weight : 1) * outside_share(seen[i], has_signs);
    sides[i].score = seen[i].normal_variation * (scanned ? of_scan : of_model);
  }
  std::ranges::stable_sort(sides, std::greater{}, &ViewGuess::score);
  return sides;
}

}  // namespace relievo
