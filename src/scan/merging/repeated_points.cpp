#include "scan/merging/repeated_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

struct PointGroup {
  Vec3f normal = Vec3f::Zero();  // sum of the normals
  std::array<std::uint32_t, 3> colour{};
  std::uint32_t members = 0;

  void add(const Cloud& cloud, std::size_t i) {
    if (cloud.has_normals()) normal += cloud.normals[i];
    ++members;
    if (!cloud.has_colours()) return;
    for (std::size_t k = 0; k < 3; ++k) colour[k] += cloud.colours[i][k];
  }
  Colour mean_colour() const {
    const auto mean = [&](std::size_t k) { return static_cast<std::uint8_t>(colour[k] / members); };
    return {mean(0), mean(1), mean(2)};
  }
};

constexpr std::size_t most_repeats = 64;    // most points that are searched for repeats of one point
constexpr std::size_t points_judged = 400;  // number of tested points, evenly distributed over the cloud
// The distances from a point to the other points, in ascending order, may have a gap: a distance that is much
// longer than the one before it. A gap is wide if only this share of scattered points has, by chance, so wide
// a gap.
constexpr double gap_by_chance = .002;
// Marching cubes may place two or three different vertices close together, which are no repeats. At a fifth
// of such positions, their distance from each other is less than `near_share` times their distance from other
// vertices. At a fiftieth of the positions, it is less than `sure_share` times that distance.
constexpr std::size_t most_by_nature = 3;
constexpr double near_share = .1, sure_share = .01;  // shares of the distance to other points
// A cloud has repeats if at least the share `least_near` of the tested points has a wide gap, or if at least
// the share `least_sure` has a gap with Gap::is_sure.
constexpr double least_sure = .05, least_near = .4;
// Points are merged if they are closer together than three times the third quartile of Gap::repeat, but at
// most a quarter of the median of Gap::other. The largest quarter of Gap::repeat is ignored, because some of
// these gaps are due to chance and surround points at several positions.
constexpr double usual_repeats = .75, repeat_room = 3, most_of_gap = .25, least_of_gap = 1e-9;

// The distances from a point to its farthest repeat, and to the nearest point that is not a repeat.
struct Gap {
  double repeat = 0, other = 0;
  bool is_sure = false;
};

// Returns the first wide gap in the ascending distances to the nearest points. Later gaps may be due to
// chance, because the search finds many points at few positions where points are repeated. If points are
// scattered on a surface, the m-th nearest is closer than s times the distance to the next one with
// probability s^(2 m).
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

// Returns the distance within which points are to be merged; nothing if hardly any points are repeated.
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

// Adds to a cloud one point for each set of repeats.
class Merging {
 public:
  Merging(const Cloud& cloud, Cloud& to) : cloud_(cloud), to_(to), is_merged_(cloud.size(), 0) {}

  // Adds one point that stands for point i and for those repeats in `around` that follow i in the cloud.
  // Point i must not be merged yet.
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
    // If all normals are equal, the first one is copied, because their mean would differ from it by rounding.
    if (cloud_.has_normals())
      to_.normals.push_back(has_one_normal ? cloud_.normals[i] : group.normal.normalized());
    if (cloud_.has_colours()) to_.colours.push_back(group.mean_colour());
    if (!cloud_.own_heights.empty()) to_.own_heights.push_back(cloud_.own_heights[i]);
    if (!cloud_.axes.empty()) to_.axes.push_back(cloud_.axes[i]);
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

// Returns the least distance for greedy Poisson-disc subsampling of random points, in units of their spacing.
// With this distance the mean spacing grows by the factor `times`. This is random sequential adsorption: of n
// points per area, the greedy choice keeps N = J (1 - 1 / sqrt(1 + 2 n / J)), where J = 0.696 / distance^2 is
// the saturation density.
double least_distance(double times) {
  const double s = (std::sqrt(1 + 8 * times * times) - 1) / 2;
  return std::sqrt(.348 * std::max(0.0, s * s - 1));
}

// Returns whether two points are on the same side of a thin wall, whose two sides are subsampled separately.
bool look_alike(const Cloud& cloud, Index a, Index b) {
  return cloud.normals[a].dot(cloud.normals[b]) > 0;
}

// Returns points in the order of the cloud, except those nearer than `distance` to an earlier returned point
// on the same side of a thin wall.
std::vector<Index> far_apart(const Cloud& cloud, double distance) {
  const KdTree<Vec3> tree(cloud.points);
  std::vector<std::uint8_t> is_covered(cloud.size(), 0);
  std::vector<KdTree<Vec3>::Match> around;
  std::vector<Index> kept;
  for (Index i = 0; i < cloud.size(); ++i) {
    if (is_covered[i]) continue;
    kept.push_back(i);
    tree.within(cloud.points[i], distance, around);
    for (const auto& [j, distance_sq] : around) is_covered[j] |= look_alike(cloud, i, j);
  }
  return kept;
}

// Returns, for each point of the cloud, the position in `kept` of the point that represents it: the nearest
// one on the same side of a thin wall. Returns no_index if none of the nearest six is on that side.
std::vector<Index> nearest_kept(const Cloud& cloud, const std::vector<Index>& kept) {
  constexpr std::size_t candidates = 6;
  std::vector<Vec3> points(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) points[k] = cloud.points[kept[k]];
  const KdTree<Vec3> tree(points);
  std::vector<Index> nearest(cloud.size(), no_index);
  parallel_for(cloud.size(), [&](std::size_t i) {
    std::array<Index, candidates> found;
    std::array<double, candidates> distances_sq;
    const std::size_t count = tree.nearest(cloud.points[i], candidates, found.data(), distances_sq.data());
    for (std::size_t c = 0; c < count && nearest[i] == no_index; ++c)
      if (look_alike(cloud, kept[found[c]], static_cast<Index>(i))) nearest[i] = found[c];
  });
  return nearest;
}

}  // namespace

std::optional<Cloud> without_repeated_points(const Cloud& cloud, const KdTree<Vec3>& tree) {
  const std::optional<double> distance = merging_distance(cloud, tree);
  if (!distance) return std::nullopt;
  std::optional<Cloud> merged(
      Cloud{{}, {}, {}, cloud.outlines, cloud.is_height_field, {}, cloud.units_per_value});
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

Cloud subsample(const Cloud& cloud, const Spacing& spacing, double wanted) {
  const double own = spacing.rho;
  const std::vector<Index> kept = far_apart(cloud, own * least_distance(wanted / own));
  const std::vector<Index> nearest = nearest_kept(cloud, kept);
  std::vector<PointGroup> groups(kept.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (nearest[i] != no_index) groups[nearest[i]].add(cloud, i);
  Cloud thin;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    thin.points.push_back(cloud.points[kept[k]]);
    thin.normals.push_back(groups[k].normal.normalized());
    if (cloud.has_colours()) thin.colours.push_back(groups[k].mean_colour());
    if (!cloud.own_heights.empty()) thin.own_heights.push_back(cloud.own_heights[kept[k]]);
  }
  return thin;
}

}  // namespace relievo
