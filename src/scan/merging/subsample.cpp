#include "scan/merging/subsample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/neighbours.h"
#include "relievo/core/parallel.h"
#include "scan/merging/point_group.h"

namespace relievo {
namespace {

// Returns the minimum distance for greedy Poisson-disc subsampling of random points, in units of their
// spacing, that makes the mean spacing grow by the factor `times`. This is random sequential adsorption: of n
// points per area the greedy choice keeps N = J (1 - 1 / sqrt(1 + 2 n / J)), where J = 0.696 / distance^2 is
// the saturation density.
double least_distance(double times) {
  const double s = (std::sqrt(1 + 8 * times * times) - 1) / 2;
  return std::sqrt(.348 * std::max(0.0, s * s - 1));
}

// Returns whether two points are on the same side of a thin wall; its sides are subsampled separately.
bool look_alike(const Cloud& cloud, Index a, Index b) {
  return cloud.normals[a].dot(cloud.normals[b]) > 0;
}

// Returns points in the order of the cloud. A point is left out if an earlier one on its side is nearer than
// `distance`.
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

// Returns for each point of the cloud the position in `kept` of the point that represents it, no_index if
// none of the nearest ones is on the same side.
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
  }
  return thin;
}

}  // namespace relievo
