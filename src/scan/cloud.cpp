#include "relievo/scan/cloud.h"

#include <algorithm>

namespace relievo {

Box bounds(const Cloud& cloud) {
  Box box;
  for (const Vec3& p : cloud.points) box.extend(p);
  return box;
}

namespace {

// The value below which that share of all lies. `values` is not empty.
double quantile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Vec3 median(const Cloud& cloud) {
  Vec3 middle;
  std::vector<double> values(cloud.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(cloud.points.begin(), cloud.points.end(), values.begin(),
                   [&](const Vec3& p) { return p[axis]; });
    middle[axis] = quantile(values, .5);
  }
  return middle;
}

}  // namespace

std::vector<Index> far_points(const Cloud& cloud) {
  if (cloud.size() == 0) return {};
  const Vec3 middle = median(cloud);
  std::vector<double> distances(cloud.size());
  std::transform(cloud.points.begin(), cloud.points.end(), distances.begin(),
                 [&](const Vec3& p) { return (p - middle).norm(); });
  const double reach = 20 * quantile(distances, .9);
  std::vector<Index> far;
  for (Index i = 0; i < cloud.size(); ++i)
    if (distances[i] > reach) far.push_back(i);
  return reach > 0 ? far : std::vector<Index>{};
}

Cloud without(const Cloud& cloud, std::span<const Index> left_out) {
  Cloud kept;
  auto next = left_out.begin();
  for (Index i = 0; i < cloud.size(); ++i) {
    if (next != left_out.end() && *next == i) {
      ++next;
      continue;
    }
    kept.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) kept.normals.push_back(cloud.normals[i]);
    if (cloud.has_colours()) kept.colours.push_back(cloud.colours[i]);
  }
  return kept;
}

}  // namespace relievo
