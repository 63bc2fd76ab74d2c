#include "relievo/scan/curvature.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"
#include "geometry/near_search.h"
#include "relievo/core/parallel.h"
#include "scan/measure_with_tree.h"

namespace relievo {
namespace {

// The radius of the neighbourhood, in h. With this radius fit_weight() approximates exp(-d^2 / h^2) best.
constexpr double support = 1.7;

struct Neighbour {
  Vec3 d;  // vector from the neighbour to the point
  Vec3 n;  // unit normal of the neighbour
};

// Returns the weight of a neighbour, which falls from 1 at the point to 0 at the radius. For a radius of 1.7
// h it approximates exp(-d^2 / h^2) without an exponential.
double fit_weight(const Neighbour& s, double radius) {
  const double rest = std::max(0.0, 1 - s.d.squaredNorm() / (radius * radius));
  return rest * rest;
}

// Returns half the divergence of a linear normal field n(x) = n0 + J x, fitted to the neighbours in the
// tangent plane by weighted least squares. This is exact where the normals vary linearly, as on spheres and
// cylinders, for any distribution of the points.
double fitted_curvature(std::span<const Neighbour> neighbours, double radius) {
  if (neighbours.size() < 6) return 0;
  Vec3 mean = Vec3::Zero();
  for (const Neighbour& s : neighbours) mean += fit_weight(s, radius) * s.n;
  const Vec3 axis = mean.normalized();
  const Vec3 t1 = axis.unitOrthogonal(), t2 = axis.cross(t1);
  Mat3 moments = Mat3::Zero();
  Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
  for (const Neighbour& s : neighbours) {
    const Vec3 place(1, -s.d.dot(t1) / radius, -s.d.dot(t2) / radius);
    const Vec3 weighted = fit_weight(s, radius) * place;
    moments += weighted * place.transpose();
    products += weighted * Eigen::RowVector2d(s.n.dot(t1), s.n.dot(t2));
  }
  const double spread = moments(0, 0) * moments(1, 1) * moments(2, 2);
  if (!(moments.determinant() > 1e-6 * spread)) return 0;  // the neighbours are on a line
  const Eigen::Matrix<double, 3, 2> field = moments.inverse() * products;
  return (field(1, 0) + field(2, 1)) / (2 * radius);
}

class CurvatureEstimator {
 public:
  CurvatureEstimator(const SearchableCloud& searchable, const CurvatureOptions& options)
      : cloud_(searchable.cloud), spacing_(searchable.spacing), options_(options) {}

  // The neighbourhood of a point. Its unit is at least rho, because near coincident points the local spacing
  // is almost 0, and the fit would contain only noise.
  NearSearch<Vec3>::Ball ball(Index i) const {
    const double unit = std::max(static_cast<double>(spacing_.local[i]), spacing_.rho);
    return {cloud_.points[i], support * options_.scale * unit};
  }

  double at(Index i, std::span<const Index> near, std::vector<Neighbour>& neighbours) const {
    neighbours.clear();
    for (const Index j : near) {
      if (cloud_.normals[j].dot(cloud_.normals[i]) <= 0) continue;
      neighbours.push_back({cloud_.points[i] - cloud_.points[j], cloud_.normals[j].cast<double>()});
    }
    const double k = fitted_curvature(neighbours, ball(i).radius);
    // Points at a distance of rho cannot represent a smaller radius of curvature.
    return std::clamp(k, -1 / spacing_.rho, 1 / spacing_.rho);
  }

 private:
  const Cloud& cloud_;
  const Spacing& spacing_;
  const CurvatureOptions& options_;
};

}  // namespace

std::vector<double> mean_curvature(const Cloud& cloud, const Spacing& spacing, std::span<const Index> queries,
                                   const CurvatureOptions& options, const Progress* progress) {
  return mean_curvature({cloud, spacing, KdTree<Vec3>(cloud.points)}, queries, options, progress);
}

std::vector<double> mean_curvature(const SearchableCloud& searchable, std::span<const Index> queries,
                                   const CurvatureOptions& options, const Progress* progress) {
  std::vector<double> curvature(queries.size(), 0.0);
  if (!searchable.cloud.has_normals() || !(searchable.spacing.rho > 0)) return curvature;
  const CurvatureEstimator estimator(searchable, options);
  parallel_ranges(queries.size(), 1024, [&](std::size_t begin, std::size_t end) {
    if (progress && progress->is_cancelled()) return;
    NearSearch<Vec3> search(searchable.tree, searchable.cloud.points);
    std::vector<Neighbour> neighbours;
    search.each(
        begin, end, [&](std::size_t q) { return estimator.ball(queries[q]); },
        [&](std::size_t q, std::span<const Index> near) {
          curvature[q] = estimator.at(queries[q], near, neighbours);
        });
  });
  return curvature;
}

std::vector<double> average_in_plane(std::span<const double> values, std::span<const Vec2> points,
                                     std::span<const Vec3f> normals, const Triangulation& triangulation,
                                     double rho) {
  // Over direct neighbours; each pass widens the average by about rho, so the result spans at least 2 rho.
  constexpr int passes = 3;
  const std::vector<Triangle>& triangles = triangulation.triangles;
  const auto own_area = [&](Index i) { return static_cast<double>(normals[i].z()); };
  // Weight of corner c + 1 in the mean at corner c.
  std::vector<std::array<double, 3>> areas(triangles.size());
  parallel_for(triangles.size(), [&](std::size_t t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Index to = triangles[t][c], from = triangles[t][(c + 1) % 3];
      areas[t][c] = std::exp(-(points[to] - points[from]).squaredNorm() / (rho * rho)) * own_area(from);
    }
  });
  std::vector<double> average(values.begin(), values.end()), weight(values.size()), sum(values.size());
  for (Index i = 0; i < values.size(); ++i) weight[i] = own_area(i);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) weight[triangles[t][c]] += areas[t][c];
  for (int pass = 0; pass < passes; ++pass) {
    for (Index i = 0; i < values.size(); ++i) sum[i] = own_area(i) * average[i];
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        sum[triangles[t][c]] += areas[t][c] * average[triangles[t][(c + 1) % 3]];
    for (std::size_t i = 0; i < values.size(); ++i)
      if (weight[i] > 0) average[i] = sum[i] / weight[i];
  }
  return average;
}

NormalisedCurvature normalise(std::span<const double> mean_curvature) {
  NormalisedCurvature result{std::vector<float>(mean_curvature.size(), 0.F)};
  if (mean_curvature.empty()) return result;
  std::vector<double> sizes(mean_curvature.size());
  std::transform(mean_curvature.begin(), mean_curvature.end(), sizes.begin(),
                 [](double k) { return std::abs(k); });
  result.unit = quantile(sizes, .99);
  if (!(result.unit > 0)) return result;
  const auto n = static_cast<double>(mean_curvature.size());
  double sum = 0, sum_sq = 0;
  for (std::size_t i = 0; i < mean_curvature.size(); ++i) {
    const double k = std::clamp(mean_curvature[i] / result.unit, -1.0, 1.0);
    result.k[i] = static_cast<float>(k);
    sum += std::abs(k);
    sum_sq += k * k;
  }
  result.delta = std::sqrt(std::max(0.0, sum_sq / n - (sum / n) * (sum / n)));
  return result;
}

}  // namespace relievo
