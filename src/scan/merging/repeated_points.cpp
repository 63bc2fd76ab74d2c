#include "scan/merging/repeated_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"
#include "relievo/core/parallel.h"
#include "scan/merging/point_group.h"

namespace relievo {
namespace {

constexpr std::size_t most_repeats = 64;    // largest number of repeats of one point
constexpr std::size_t points_judged = 400;  // number of judged points, evenly taken from the whole cloud
// The share of randomly scattered points around which there is by chance a gap as wide as that around
// repeats.
constexpr double gap_by_chance = .002;
// Marching cubes put two or three vertices close together without repeating any. At a fifth of the places
// these are nearer than a tenth of the distance to other vertices, at a fiftieth nearer than a hundredth.
constexpr std::size_t most_by_nature = 3;
constexpr double near_share = .1, sure_share = .01;  // shares of the distance to other points
constexpr double least_sure = .05,
                 least_near = .4;  // least shares of such points in a cloud with repeats
// Points are merged within three times the distance that three quarters of the repeats do not exceed, but at
// most within a quarter of the distance to other places. The remaining quarter of the repeats may be chance
// gaps around the points of several places.
constexpr double usual_repeats = .75, repeat_room = 3, most_of_gap = .25, least_of_gap = 1e-9;

// The distances from a point to the farthest one that repeats it, and to the nearest that does not.
struct Gap {
  double repeat = 0, other = 0;
  bool is_sure = false;
};

// Returns the first wide gap in the distances to the nearest points. Later gaps may be there by chance,
// because repeats make points many and their places few. Of points scattered over a surface, the m-th is
// nearer than a share s of the distance to the next one with probability s^(2 m).
std::optional<Gap> gap_around(const KdTree<Vec3>& tree, const Vec3& point) {
  std::array<Index, most_repeats + 2> found;
  std::array<double, most_repeats + 2> distances_sq;
  const std::size_t count = tree.nearest(point, found.size(), found.data(), distances_sq.data());
  for (std::size_t m = 1; m + 1 < count; ++m) {
    const bool is_few = m < most_by_nature;
    if (!(distances_sq[m + 1] > 0)) continue;
    const double share_sq = distances_sq[m] / distances_sq[m + 1];
    const double most_sq =
        is_few ? near_share * near_share : std::min(.25, std::pow(gap_by_chance, 1 / static_cast<double>(m)));
    if (share_sq < most_sq)
      return Gap{std::sqrt(distances_sq[m]), std::sqrt(distances_sq[m + 1]),
                 !is_few || share_sq < sure_share * sure_share};
  }
  return std::nullopt;
}

// Returns the distance within which points are to be merged; nothing if hardly any repeat others.
std::optional<double> merging_distance(const Cloud& cloud, const KdTree<Vec3>& tree) {
  const std::size_t judged = std::min(points_judged, cloud.size());
  std::vector<std::optional<Gap>> gaps(judged);
  parallel_for(
      judged, [&](std::size_t i) { gaps[i] = gap_around(tree, cloud.points[i * cloud.size() / judged]); },
      16);
  const auto at_least = [&](double share, auto&& is_one) {
    return static_cast<double>(std::ranges::count_if(gaps, is_one)) >= share * static_cast<double>(judged);
  };
  const bool are_all = at_least(least_near, [](const auto& gap) { return gap.has_value(); });
  if (!are_all && !at_least(least_sure, [](const auto& gap) { return gap && gap->is_sure; }))
    return std::nullopt;
  std::vector<double> repeats, others;
  for (const std::optional<Gap>& gap : gaps)
    if (gap && (are_all || gap->is_sure)) repeats.push_back(gap->repeat), others.push_back(gap->other);
  if (others.empty()) return std::nullopt;
  const double other = median(others);
  return std::clamp(repeat_room * quantile(repeats, usual_repeats), least_of_gap * other,
                    most_of_gap * other);
}

// Adds to a cloud one point for each set of points that repeat each other.
class Merging {
 public:
  Merging(const Cloud& cloud, Cloud& to) : cloud_(cloud), to_(to), is_merged_(cloud.size(), 0) {}

  // Adds one point for point i, which is not merged yet, and all later points around it that repeat it.
  void add(Index i, std::span<const KdTree<Vec3>::Match> around) {
    PointGroup group;
    group.add(cloud_, i);
    bool has_one_normal = true;
    for (const auto& [j, distance_sq] : around) {
      if (j <= i || is_merged_[j] || points_apart(i, j)) continue;
      is_merged_[j] = 1;
      group.add(cloud_, j);
      has_one_normal = has_one_normal && (!cloud_.has_normals() || cloud_.normals[i] == cloud_.normals[j]);
    }
    to_.points.push_back(cloud_.points[i]);
    // Rounding would make the mean of equal normals differ from them.
    if (cloud_.has_normals())
      to_.normals.push_back(has_one_normal ? cloud_.normals[i] : group.normal.normalized());
    if (cloud_.has_colours()) to_.colours.push_back(group.mean_colour());
  }

  bool is_merged(Index i) const { return is_merged_[i]; }

 private:
  bool points_apart(Index i, Index j) const {
    return cloud_.has_normals() && cloud_.normals[i].dot(cloud_.normals[j]) < 0;
  }

  const Cloud& cloud_;
  Cloud& to_;
  std::vector<std::uint8_t> is_merged_;
};

}  // namespace

std::optional<Cloud> without_repeated_points(const Cloud& cloud, const KdTree<Vec3>& tree) {
  const std::optional<double> distance = merging_distance(cloud, tree);
  if (!distance) return std::nullopt;
  std::optional<Cloud> merged(Cloud{{}, {}, {}, cloud.outlines, cloud.is_height_field});
  Merging merging(cloud, *merged);
  std::vector<KdTree<Vec3>::Match> around;
  for (Index i = 0; i < cloud.size(); ++i) {
    if (merging.is_merged(i)) continue;
    tree.within(cloud.points[i], *distance, around);
    merging.add(i, around);
  }
  return merged;
}

Cloud without_repeated_points(Cloud cloud) {
  if (std::optional<Cloud> merged = without_repeated_points(cloud, KdTree<Vec3>(cloud.points)))
    return std::move(*merged);
  return cloud;
}

}  // namespace relievo
