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
  const std::vector<Index> kept =
      indices_where(cloud.size(), [next = erased.begin(), &erased](Index i) mutable {
        const bool is_erased = next != erased.end() && *next == i;
        next += is_erased;
        return !is_erased;
      });
  return {pick(cloud.points, kept), pick(cloud.normals, kept), pick(cloud.colours, kept),
          cloud.outlines,           cloud.is_height_field,     pick(cloud.own_heights, kept),
          cloud.units_per_value,    pick(cloud.axes, kept)};
}

}  // namespace relievo
