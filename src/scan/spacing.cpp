#include "relievo/scan/spacing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/quantile.h"
#include "relievo/core/parallel.h"
#include "scan/measure_with_tree.h"

namespace relievo {
namespace {

// rho is so large that the share `almost_all` of the points has local spacings of at most largest_ratio * rho. The
// other points may be outliers.
constexpr double almost_all = .98, largest_ratio = 4;

}  // namespace

Spacing measure_spacing(const Cloud& cloud) {
  return measure_spacing(KdTree<Vec3>(cloud.points), cloud.points);
}

Spacing measure_spacing(const KdTree<Vec3>& tree, std::span<const Vec3> points, const Progress* progress) {
  constexpr std::size_t k = spacing_neighbours;
  Spacing spacing;
  spacing.local.assign(points.size(), 0.F);
  spacing.nearest.resize(points.size());
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        if (progress && progress->is_cancelled()) return;
        std::array<Index, k + 1> found;
        std::array<double, k + 1> distances_sq;
        found.fill(no_index);
        const std::size_t count = tree.nearest(points[i], k + 1, found.data(), distances_sq.data());
        if (count < 2) return;
        const double area = std::numbers::pi * distances_sq[count - 1] / static_cast<double>(count - 1);
        spacing.local[i] = static_cast<float>(std::sqrt(area));
        // Coincident points may precede the point itself. Leaves out one entry: the point, or the last entry
        // if the point is not in the list.
        const auto self = std::find(found.begin(), found.end() - 1, static_cast<Index>(i));
        std::copy(self + 1, found.end(), std::copy(found.begin(), self, spacing.nearest[i].begin()));
      },
      1024);
  if (points.size() < 2 || (progress && progress->is_cancelled())) return spacing;
  // rho is the median of the local spacings, because some far outliers or dense spots would change the mean.
  // If the density varies much, as among the corners of a mesh, rho is larger than the median. With the
  // median, sparse parts would count as noise and holes.
  std::vector<float> distances = spacing.local;
  const double least = static_cast<double>(quantile(distances, almost_all)) / largest_ratio;
  spacing.rho = static_cast<double>(median(distances));
  spacing.is_uneven = spacing.rho < least;
  if (spacing.is_uneven) spacing.rho = least;
  return spacing;
}

}  // namespace relievo
