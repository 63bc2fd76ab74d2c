#include "relievo/scan/normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <vector>

#include "core/lists.h"
#include "geometry/neighbours.h"
#include "relievo/core/parallel.h"
#include "relievo/scan/view.h"
#include "scan/coarse_visibility.h"
#include "scan/measure_with_tree.h"

namespace relievo {
namespace {

constexpr std::size_t most_neighbours = 64;  // per point; arrays of this size are on the stack

using Eigenvectors = Eigen::SelfAdjointEigenSolver<Mat3>;

// Returns a quadratic form of a plane's normal. Its eigenvector with the least eigenvalue is the likeliest
// normal of the plane through the members. Two kinds of deviation are assumed to be normally
// distributed: the distances of the points from the plane, and the angles between the points' axes (see
// Cloud::axes) and the plane's normal. The form is the sum of the squared deviations, divided by the variance
// of their kind. This variance is estimated from the plane that minimises deviations of this kind alone.
// `covariance` has the trace 1.
Mat3 with_axes(const Mat3& covariance, std::span<const Vec3f> axes, std::span<const Index> members) {
  constexpr double fewest = 4, least_variance = 1e-9;
  Mat3 sum = Mat3::Zero();
  double known = 0;
  for (const Index i : members) {
    const Vec3 axis = axes[i].cast<double>();
    sum += axis * axis.transpose();
    known += axis.isZero(0) ? 0 : 1;
  }
  const auto count = static_cast<double>(members.size());
  if (known < fewest || count < fewest) return covariance;
  const double offsets =
      Eigenvectors().computeDirect(covariance, Eigen::EigenvaluesOnly).eigenvalues()[0] / (count - 3);
  const double slants = (known - Eigenvectors().computeDirect(sum, Eigen::EigenvaluesOnly).eigenvalues()[2]) /
                        (2 * (known - 1));
  const double ratio = std::max(offsets, least_variance) / std::max(slants, least_variance);
  const Mat3 both = covariance + ratio * (known * Mat3::Identity() - sum);
  return both / both.trace();
}

// Returns the direction of least variance of the members, or (0, 0, 1) if they coincide.
Vec3f plane_normal(const Cloud& cloud, std::span<const Index> members) {
  const std::vector<Vec3>& points = cloud.points;
  Vec3 mean = Vec3::Zero();
  for (const Index i : members) mean += points[i];
  mean /= static_cast<double>(members.size());
  Mat3 covariance = Mat3::Zero();
  for (const Index i : members) covariance += (points[i] - mean) * (points[i] - mean).transpose();
  covariance /= std::max(covariance.trace(), 1e-300);
  if (!cloud.axes.empty()) covariance = with_axes(covariance, cloud.axes, members);
  Eigenvectors solver;
  solver.computeDirect(covariance);
  const Vec3 normal = solver.eigenvectors().col(0);
  return normal.allFinite() && normal.norm() > .5 ? Vec3f(normal.cast<float>().normalized())
                                                  : Vec3f(Vec3f::UnitZ());
}

}  // namespace

Vec3f unit_normal(const Vec3& n) {
  if (!n.allFinite() || n.isZero(0)) return Vec3f::Zero();
  const Vec3f rounded = n.cast<float>();
  const double rounding = 1e-6;  // several times the rounding error of the squared length of three floats
  if (std::abs(rounded.cast<double>().squaredNorm() - 1) <= rounding) return rounded;
  // n is scaled first, because its squares may overflow.
  return (n / n.cwiseAbs().maxCoeff()).normalized().cast<float>();
}

std::vector<Vec3f> estimated_normals(const SearchableCloud& searchable, std::span<const Index> points,
                                     std::size_t neighbours, const Progress* progress) {
  const std::span<const Vec3> all = searchable.cloud.points;
  const std::size_t k = std::min({neighbours, all.size(), most_neighbours});
  std::vector<Vec3f> normals(points.size(), Vec3f::Zero());
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        if (progress && progress->is_cancelled()) return;
        std::array<Index, most_neighbours> members;
        std::array<double, most_neighbours> distances_sq;
        const std::size_t found =
            searchable.tree.nearest(all[points[i]], k, members.data(), distances_sq.data());
        normals[i] = plane_normal(searchable.cloud, std::span(members).first(found));
      },
      1024);
  return normals;
}

void estimate_normals(Cloud& cloud, std::size_t neighbours, const Progress* progress) {
  if (cloud.size() < 3) return;
  const KdTree<Vec3> tree(cloud.points);
  cloud.normals = estimated_normals({cloud, {}, tree}, all_indices(cloud.size()), neighbours, progress);
}

void turn_to_viewer(Cloud& viewed) {
  for (Vec3f& n : viewed.normals)
    if (n.z() < 0) n = -n;
}

void spread_normal_signs(Cloud& viewed, const Spacing& spacing, std::span<const Index> seen) {
  constexpr float seen_well = .5F;  // n_z at a tilt of 60 degrees; if it is steeper, the sign is unreliable
  // The points whose normals have their final signs, in the order in which they got them. This is also the
  // queue of a breadth-first search.
  std::vector<Index> settled;
  std::vector<std::uint8_t> is_settled(viewed.size(), 0);
  const auto settle = [&](Index i) {
    is_settled[i] = 1;
    settled.push_back(i);
  };
  for (const Index i : seen)
    if (viewed.normals[i].z() > seen_well) settle(i);
  for (std::size_t next = 0; next < settled.size(); ++next)
    for (const Index i : spacing.nearest[settled[next]]) {
      if (i == no_index || is_settled[i]) continue;
      Vec3f& n = viewed.normals[i];
      // The neighbours with final signs vote on the sign of n, so that a single wrong sign does not spread.
      float agreement = n.dot(viewed.normals[settled[next]]);
      for (const Index j : spacing.nearest[i])
        if (j != no_index && is_settled[j]) agreement += n.dot(viewed.normals[j]);
      if (agreement < 0) n = -n;
      settle(i);
    }
}

bool normals_point_inward(const Cloud& cloud) {
  if (!cloud.has_normals()) return false;
  std::vector<View> sides;
  for (const char* side : {"front", "back", "left", "right", "top", "bottom"})
    sides.push_back(*parse_view(side));
  return normals_point_inward(coarse_visibility(cloud, sides));
}

void flip_normals(Cloud& cloud) {
  for (Vec3f& n : cloud.normals) n = -n;
}

}  // namespace relievo
