// The noise of a scan. Declared in noise.h. Tested by tests/scan/noise_test.cpp.
#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/angle.h"
#include "core/quantile.h"
#include "geometry/neighbours.h"
#include "relievo/core/parallel.h"
#include "scan/noise/noise.h"

namespace relievo {
namespace {

constexpr std::size_t enough_places = 4000;
constexpr std::size_t fewest_places = 100;
// The number of a point, its neighbours, and the neighbours of these.
constexpr std::size_t most_members = 1 + spacing_neighbours + spacing_neighbours * spacing_neighbours;
// The noise is estimated from this quantile of the local scatters, divided by the ratio of the quantile to
// the standard deviation. The ratio is the root of q / 15, where q is the same quantile of chi square with 15
// degrees of freedom, about the number that a fit leaves.
constexpr double quiet_share = .25, quiet_deviation = .86;
constexpr double least_noise = .12;  // in rho: clean scans of fine details scatter by up to this
// The least scatter of normals where the points scatter by one sampling distance. Normals estimated from 16
// neighbours scatter so much on spheres and planes.
constexpr double normal_scatter_per_noise = to_radians(11);

struct LocalScatter {
  double points;   // in rho
  double normals;  // in radians, per component
};

// Returns the numbers of a point, its neighbours and the neighbours of these, each once.
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

// Returns how much the points and normals around a point scatter about fitted quadratic polynomials; nothing
// if there are too few neighbours.
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

constexpr int fits = 3;                              // each is weighted by the deviations from the fit before
constexpr double least_radius = 2, more_radius = 3;  // radius = spacing (2 + 3 noise)
constexpr double least_deviation = to_radians(8),
                 more_deviation = to_radians(30);  // of normals: the least, and that per unit of noise
constexpr double facing = .2;      // least cosine between the normals of neighbours on one side of a wall
constexpr double stiffness = .01;  // keeps the field almost constant where neighbours lie on a line

struct NearPoint {
  Vec3 d;  // from the point to the neighbour, in radii
  Vec3 n;  // the neighbour's unit normal
};

// The surface around a point: its normals, which vary linearly in the tangent plane, and its height above the
// point in radii.
struct LocalSurface {
  Vec3 axis, t1, t2;
  Eigen::Matrix<double, 3, 2> field = Eigen::Matrix<double, 3, 2>::Zero();
  double height = 0;

  explicit LocalSurface(const Vec3& normal)
      : axis(normal), t1(normal.unitOrthogonal()), t2(normal.cross(t1)) {}

  Vec3 normal_at(const Vec3& d) const {
    const Eigen::RowVector2d slope = Eigen::RowVector3d(1, d.dot(t1), d.dot(t2)) * field;
    return (axis + slope[0] * t1 + slope[1] * t2).normalized();
  }
};

// The deviations at which neighbours lose weight.
struct Tolerances {
  double normals_sq;  // variance of the deviation of normals
  double heights_sq;  // variance of the deviation of heights, in radii^2
};

class NoiseFilter {
 public:
  NoiseFilter(const Cloud& cloud, const Spacing& spacing, double noise)
      : cloud_(cloud), spacing_(spacing), noise_(noise), tree_(cloud.points) {}

  // Returns the point moved onto the fitted surface, and the surface's normal there.
  std::pair<Vec3, Vec3f> at(Index i, std::vector<KdTree<Vec3>::Match>& matches,
                            std::vector<NearPoint>& neighbours) const {
    const double unit = std::max(static_cast<double>(spacing_.local[i]), spacing_.rho);
    const double radius = (least_radius + more_radius * noise_) * unit;
    tree_.within(cloud_.points[i], radius, matches);
    neighbours.clear();
    for (const auto& [j, distance_sq] : matches)
      neighbours.push_back(
          {(cloud_.points[j] - cloud_.points[i]) / radius, cloud_.normals[j].cast<double>()});
    const double deviation = std::max(least_deviation, more_deviation * noise_);
    const double height = noise_ * unit / radius;
    const Tolerances tolerances{deviation * deviation, height * height};
    LocalSurface surface(cloud_.normals[i].cast<double>());
    for (int k = 0; k < fits; ++k) surface = refitted(surface, neighbours, tolerances);
    const Vec3 normal = surface.normal_at(Vec3::Zero());
    return {cloud_.points[i] + radius * surface.height * normal, normal.cast<float>()};
  }

 private:
  static LocalSurface refitted(const LocalSurface& before, std::span<const NearPoint> neighbours,
                               const Tolerances& tolerances) {
    LocalSurface after(before.normal_at(Vec3::Zero()));
    Mat3 moments = Mat3::Zero();
    Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
    double heights = 0;
    for (const auto& [d, n] : neighbours) {
      const double cosine = n.dot(after.axis);
      if (cosine <= facing) continue;
      // The mean of both normals makes this height exact on spheres, too.
      const double height = d.dot(n + after.axis) / 2;
      const double deviation_sq = (n - before.normal_at(d)).squaredNorm();
      const double off = height - before.height;
      const double rest = std::max(0.0, 1 - d.squaredNorm());
      const double weight =
          rest * rest *
          std::exp(-deviation_sq / (2 * tolerances.normals_sq) - off * off / (4 * tolerances.heights_sq));
      const Vec3 place(1, d.dot(after.t1), d.dot(after.t2));
      moments += weight * place * place.transpose();
      products += weight * place * Eigen::RowVector2d(n.dot(after.t1), n.dot(after.t2)) / cosine;
      heights += weight * height;
    }
    const double sum = moments(0, 0);
    if (!(sum > 0)) return before;
    moments(1, 1) += stiffness * sum;
    moments(2, 2) += stiffness * sum;
    after.field = moments.ldlt().solve(products);
    after.height = heights / sum;
    return after;
  }

  const Cloud& cloud_;
  const Spacing& spacing_;
  double noise_;
  KdTree<Vec3> tree_;
};

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

void remove_noise(Cloud& cloud, const Spacing& spacing, double noise, const Progress* progress) {
  if (!cloud.has_normals() || !(spacing.rho > 0)) return;
  std::vector<Vec3> points(cloud.size());
  std::vector<Vec3f> normals(cloud.size());
  const NoiseFilter filter(cloud, spacing, noise);
  parallel_ranges(cloud.size(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<KdTree<Vec3>::Match> matches;
    std::vector<NearPoint> neighbours;
    if (progress && progress->is_cancelled()) return;
    for (std::size_t i = begin; i < end; ++i)
      std::tie(points[i], normals[i]) = filter.at(static_cast<Index>(i), matches, neighbours);
  });
  if (progress && progress->is_cancelled()) return;
  cloud.points = std::move(points);
  cloud.normals = std::move(normals);
}

}  // namespace relievo
