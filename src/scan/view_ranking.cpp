// Ranks the sides of a model. Declared in view.h. The constants were chosen on real scans:
// docs/decisions/best-view.md.
#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/view.h"
#include "scan/coarse_visibility.h"

namespace relievo {
namespace {

using Sides = std::array<ViewGuess, 6>;

// The six sides of models with Y or Z upwards. Opposite sides follow each other; the side that is the front
// in most files comes first.
constexpr Sides y_up{{{"front", ""}, {"back", ""}, {"left", ""}, {"right", ""}, {"bottom", ""}, {"top", ""}}};
constexpr Sides z_up{
    {{"bottom", ""}, {"top", "0,0,1"}, {"left", "0,0,1"}, {"right", "0,0,1"}, {"front", ""}, {"back", ""}}};

constexpr double front_weight = 1.6;    // factor of the side that is the front in most files
constexpr double beside_scan = .25;     // factor of the sides at right angles to the direction of a scan
constexpr double one_layer_share = .8;  // least one_layer of one-sided scans; closed models stay below .45
constexpr double same_share = .05;      // smaller differences of one_layer between axes are ignored

// Returns the area of the box of the lowest points along an axis, as a share of the area of the whole box.
// Both areas are seen along that axis.
double foot_along(const Cloud& cloud, const Box& box, int axis) {
  constexpr double foot = .03;  // share of the height
  const double least = box.min[axis] + foot * box.size()[axis];
  Box low;
  for (const Vec3& p : cloud.points)
    if (p[axis] <= least) low.extend(p);
  double share = 1;
  for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
    share *= box.size()[other] > 0 ? low.size()[other] / box.size()[other] : 1;
  return share;
}

bool stands_on_z(const Cloud& cloud) {
  constexpr double wide = .3, wider = 3;
  const Box box = bounds(cloud);
  const double foot = foot_along(cloud, box, 2);
  return foot > wide && foot > wider * foot_along(cloud, box, 1);
}

std::vector<CoarseVisibility> seen_from(const Sides& sides, const Cloud& cloud, NormalSigns signs) {
  std::vector<View> views;
  for (const ViewGuess& side : sides) views.push_back(parse_view(side.name, side.up).value_or(View{}));
  return coarse_visibility(cloud, views, signs);
}

// Returns the index of the first of two opposite sides if one of them shows everything that was scanned; 6 if
// the cloud has several layers.
std::size_t scanned_axis(const std::vector<CoarseVisibility>& seen) {
  const auto share = [&](std::size_t i) { return std::min(seen[i].one_layer, seen[i + 1].one_layer); };
  const std::array<std::size_t, 3> axes{0, 4, 2};
  double most = 0;
  for (const std::size_t axis : axes) most = std::max(most, share(axis));
  if (most < one_layer_share) return 6;
  return *std::ranges::find_if(axes, [&](std::size_t axis) { return share(axis) >= most - same_share; });
}

// Returns the share of a side that is the outside of its model. Normals with unknown signs do not show it,
// but an outside is nearer to the viewer in its middle than along its outline.
double outside_share(const CoarseVisibility& seen, bool has_signs) {
  constexpr double perhaps_hollow = .5;
  if (has_signs) return seen.facing_share;
  return seen.bulge < 0 ? perhaps_hollow : 1;
}

// Returns whether the first of two opposite sides is the one that was scanned.
bool is_first_outside(const CoarseVisibility& first, const CoarseVisibility& second, bool has_signs) {
  return has_signs ? first.facing_share >= second.facing_share : first.bulge >= second.bulge;
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
  Sides sides = y_up;
  std::vector<CoarseVisibility> seen = seen_from(sides, cloud, signs);
  if (has_signs && normals_point_inward(seen)) {
    signs = NormalSigns::inward;
    seen = seen_from(sides, cloud, signs);
  }
  const std::size_t scanned = scanned_axis(seen);
  if (scanned < 6) {
    const bool is_first = is_first_outside(seen[scanned], seen[scanned + 1], has_signs);
    for (std::size_t i = 0; i < 6; ++i) sides[i].score = beside_scan * seen[i].normal_variation;
    sides[scanned].score = is_first ? seen[scanned].normal_variation : 0;
    sides[scanned + 1].score = is_first ? 0 : seen[scanned + 1].normal_variation;
  } else {
    if (stands_on_z(cloud)) {
      sides = z_up;
      seen = seen_from(sides, cloud, signs);
    }
    for (std::size_t i = 0; i < 6; ++i)
      sides[i].score =
          (i == 0 ? front_weight : 1) * outside_share(seen[i], has_signs) * seen[i].normal_variation;
  }
  std::ranges::stable_sort(sides, std::greater{}, &ViewGuess::score);
  return sides;
}

}  // namespace relievo
