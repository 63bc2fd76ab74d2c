#include "geometry/extent.h"

#include <algorithm>

#include "relievo/core/parallel.h"

namespace relievo {

double longer_side_of(std::span<const Vec3> points) {
  return Box::of(points).longer_side();
}

std::vector<double> depth_ranks(std::span<const Vec3> points) {
  std::vector<double> sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) sorted[i] = points[i].z();
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> ranks(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), points[i].z()) - sorted.begin();
    ranks[i] = static_cast<double>(at) / static_cast<double>(points.size());
  });
  return ranks;
}

}  // namespace relievo
