// Measures the noise of a scan. Declared in noise.h.
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/angle.h"
#include "core/quantile.h"
#include "relievo/core/parallel.h"
#include "scan/noise/noise.h"

namespace relievo {
namespace {

constexpr std::size_t enough_places = 4000;
constexpr std::size_t fewest_places = 100;
// The largest number of points in two_rings(): a point, its neighbours, and their neighbours.
constexpr std::size_t most_members = 1 + spacing_neighbours + spacing_neighbours * spacing_neighbours;
// The noise is this quantile of the local scatters, divided by `quiet_deviation`, the ratio of the quantile to the
// standard deviation. The ratio is sqrt(q / 15), where q is the same quantile of a chi-square distribution with 15
// degrees of freedom. About 15 degrees of freedom are left after the fit in scatter_around().
constexpr double quiet_share = .25, quiet_deviation = .86;
constexpr double least_noise = .12;  // in rho; clean scans with fine details scatter up to this much
// Noise of one sampling distance makes estimated normals scatter by at least this much. It was measured for normals
// estimated from 16 neighbours on spheres and planes.
constexpr double normal_scatter_per_noise = to_radians(11);

struct LocalScatter {
  double points;   // scatter of the points, in rho (sampling distances)
  double normals;  // scatter of each component of the normals, in radians
};

// Returns the indices of a point, its neighbours and their neighbours, each one once.
std::vector<Index> two_rings(const Spacing& spacing, Index middle) {
  std::vector<Index> members{middle};
  members.reserve(most_members);
  for (const Index i : spacing.nearest[middle]) {
    if (i == no_index) continue;
    members.push_back(i);
    for (const Index j : spacing.nearest[i])
      if (j != no_index) members.push_back(j);
  }
  std::ranges::sort(members);
  members.erase(std::ranges::unique(members).begin(), members.end());
  return members;
}

// Returns the scatter of the points and normals near a point about fitted quadratic polynomials; nothing if
// there are too few neighbours.
std::optional<LocalScatter> scatter_around(const Cloud& cloud, const Spacing& spacing, Index middle) {
  constexpr int unknowns = 6, fewest = 14;
  const std::vector<Index> members = two_rings(spacing, middle);
  const Vec3 axis = cloud.normals[middle].cast<double>();
  const Vec3 t1 = axis.unitOrthogonal(), t2 = axis.cross(t1);
  Eigen::Matrix<double, Eigen::Dynamic, unknowns, 0, most_members> places(members.size(), unknowns);
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most_members> values(members.size(), 3);
  int used = 0;
  for (const Index i : members) {
    const Vec3 n = cloud.normals[i].cast<double>();
    if (n.dot(axis) <= .3) continue;
    const Vec3 d = (cloud.points[i] - cloud.points[middle]) / spacing.rho;
    const double x = d.dot(t1), y = d.dot(t2);
    places.row(used) << 1, x, y, x * x, x * y, y * y;
    values.row(used++) << d.dot(axis), n.dot(t1) / n.dot(axis), n.dot(t2) / n.dot(axis);
  }
  if (used < fewest) return std::nullopt;
  const auto a = places.topRows(used);
  const auto b = values.topRows(used);
  const Eigen::Matrix<double, unknowns, 3> fit = a.colPivHouseholderQr().solve(b);
  const Eigen::RowVector3d squares = (b - a * fit).colwise().squaredNorm() / (used - unknowns);
  return LocalScatter{std::sqrt(squares[0]), std::sqrt((squares[1] + squares[2]) / 2)};
}

}  // namespace

double measure_noise(const Cloud& cloud, const Spacing& spacing) {
  if (!cloud.has_normals() || !(spacing.rho > 0)) return 0;
  const std::size_t step = 1 + cloud.size() / enough_places;
  std::vector<std::optional<LocalScatter>> found(cloud.size() / step);
  parallel_for(
      found.size(),
      [&](std::size_t i) { found[i] = scatter_around(cloud, spacing, static_cast<Index>(i * step)); }, 64);
  std::vector<double> points, normals;
  for (const auto& scatter : found) {
    if (!scatter) continue;
    points.push_back(scatter->points);
    normals.push_back(scatter->normals);
  }
  if (points.size() < fewest_places) return 0;
  const double noise =
      std::min(quantile(points, quiet_share), quantile(normals, quiet_share) / normal_scatter_per_noise) /
      quiet_deviation;
  return noise < least_noise ? 0 : std::min(noise, 1.0);
}

}  // namespace relievo
