#include "relievo/scan/cloud.h"

#include "core/lists.h"
#include "core/quantile.h"
#include "relievo/core/parallel.h"

namespace relievo {

Box bounds(const Cloud& cloud) {
  return Box::of(cloud.points);
}

namespace {

Vec3 median_of(const Cloud& cloud) {
  Vec3 middle;
  parallel_for(
      3,
      [&](std::size_t axis) {
        std::vector<double> values;
        values.reserve(cloud.size());
        for (const Vec3& p : cloud.points) values.push_back(p[static_cast<Eigen::Index>(axis)]);
        middle[static_cast<Eigen::Index>(axis)] = quantile(values, .5);
      },
      1);
  return middle;
}

}  // namespace

std::vector<Index> outliers(const Cloud& cloud) {
  if (cloud.size() == 0) return {};
  const Vec3 middle = median_of(cloud);
  std::vector<double> distances(cloud.size());
  parallel_for(cloud.size(), [&](std::size_t i) { distances[i] = (cloud.points[i] - middle).norm(); });
  // The factor 20 keeps the ends of long, thin models, although they are far from the median. (If points are
  // evenly distributed on a line, none is farther from the median than 1.2 times this quantile of the
  // distances.)
  const double radius = 20 * quantile(std::vector(distances), .9);
  return indices_where(cloud.size(), [&](Index i) { return radius > 0 && distances[i] > radius; });
}

Cloud erase_points(const Cloud& cloud, std::span<const Index> erased) {
  Cloud kept;
  kept.outlines = cloud.outlines;
  kept.is_height_field = cloud.is_height_field;
  kept.units_per_value = cloud.units_per_value;
  auto next = erased.begin();
  for (Index i = 0; i < cloud.size(); ++i) {
    if (next != erased.end() && *next == i) {
      ++next;
      continue;
    }
    kept.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) kept.normals.push_back(cloud.normals[i]);
    if (cloud.has_colours()) kept.colours.push_back(cloud.colours[i]);
    if (!cloud.own_heights.empty()) kept.own_heights.push_back(cloud.own_heights[i]);
    if (!cloud.axes.empty()) kept.axes.push_back(cloud.axes[i]);
  }
  return kept;
}

}  // namespace relievo
