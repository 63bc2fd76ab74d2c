#include "relievo/scan/curvature.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"
#include "core/simd.h"
#include "geometry/near_search.h"
#include "relievo/core/parallel.h"
#include "scan/measure_with_tree.h"

namespace relievo {
namespace {

// The radius of the neighbourhood, in units of h, the scale of the Gaussian exp(-d^2 / h^2). With this radius
// fit_weights() approximates the Gaussian best.
constexpr double support = 1.7;

// Four neighbours of a point. Unused entries lie beyond the radius, where the weight is 0.
struct FourNeighbours {
  Double4 x{2, 2, 2, 2}, y = {}, z = {};  // vector from the neighbour to the point, in radii
  Double4 n_x = {}, n_y = {}, n_z = {};   // the neighbour's unit normal
};

// Returns the weights of neighbours, which fall from 1 at the point to 0 at the radius. They approximate a Gaussian,
// but need no exponential.
RELIEVO_INLINE Double4 fit_weights(const FourNeighbours& s) {
  const Double4 rest = 1 - (s.x * s.x + s.y * s.y + s.z * s.z), inside = rest > 0 ? rest : Double4{};
  return inside * inside;
}

RELIEVO_INLINE Vec3 mean_normal(std::span<const FourNeighbours> neighbours) {
  Double4 x = {}, y = {}, z = {};
  for (const FourNeighbours& s : neighbours) {
    const Double4 w = fit_weights(s);
    x += w * s.n_x, y += w * s.n_y, z += w * s.n_z;
  }
  return {total(x), total(y), total(z)};
}

// Sums of w a b^T over the neighbours of a point. w is the weight of a neighbour. a = (1, u, v), where u and
// v are the neighbour's coordinates in the tangent plane. In `moments`, b is equal to a. In `products`, b has
// the two components of the neighbour's normal in the tangent plane.
struct TangentSums {
  Mat3 moments;
  Eigen::Matrix<double, 3, 2> products;
};

RELIEVO_INLINE TangentSums sums_in(const Vec3& t1, const Vec3& t2,
                                   std::span<const FourNeighbours> neighbours) {
  Double4 one = {}, u1 = {}, v1 = {}, uu = {}, uv = {}, vv = {}, p1 = {}, pu = {}, pv = {}, q1 = {}, qu = {},
          qv = {};
  for (const FourNeighbours& s : neighbours) {
    const Double4 w = fit_weights(s);
    const Double4 u = -(s.x * t1.x() + s.y * t1.y() + s.z * t1.z()),
                  v = -(s.x * t2.x() + s.y * t2.y() + s.z * t2.z()), wu = w * u, wv = w * v;
    const Double4 p = s.n_x * t1.x() + s.n_y * t1.y() + s.n_z * t1.z(),
                  q = s.n_x * t2.x() + s.n_y * t2.y() + s.n_z * t2.z();
    one += w, u1 += wu, v1 += wv, uu += wu * u, uv += wu * v, vv += wv * v;
    p1 += w * p, pu += wu * p, pv += wv * p, q1 += w * q, qu += wu * q, qv += wv * q;
  }
  const double u = total(u1), v = total(v1), mixed = total(uv);
  return {
      Mat3{{total(one), u, v}, {u, total(uu), mixed}, {v, mixed, total(vv)}},
      Eigen::Matrix<double, 3, 2>{{total(p1), total(q1)}, {total(pu), total(qu)}, {total(pv), total(qv)}}};
}

// Returns half the divergence of the normal field n(x) = n0 + J x, fitted to the neighbours by weighted least
// squares in the tangent plane. This is exact where the normals vary linearly, as on spheres and cylinders,
// however the points are scattered.
double fitted_curvature(std::span<const FourNeighbours> neighbours, double radius) {
  const Vec3 axis = RELIEVO_WIDE(mean_normal(neighbours)).normalized();
  const Vec3 t1 = axis.unitOrthogonal(), t2 = axis.cross(t1);
  const auto [moments, products] = RELIEVO_WIDE(sums_in(t1, t2, neighbours));
  const double spread = moments(0, 0) * moments(1, 1) * moments(2, 2);
  if (!(moments.determinant() > 1e-6 * spread)) return 0;  // the neighbours are on a line
  const Eigen::Matrix<double, 3, 2> field = moments.inverse() * products;
  return (field(1, 0) + field(2, 1)) / (2 * radius);
}

class CurvatureEstimator {
 public:
  CurvatureEstimator(const SearchableCloud& searchable, const CurvatureOptions& options)
      : cloud_(searchable.cloud), spacing_(searchable.spacing), options_(options) {}

  // Returns the ball of neighbours for the fit at a point. The unit of its radius is at least rho, because near
  // coincident points the local spacing is almost 0, and the fit would contain only noise.
  NearSearch<Vec3>::Ball ball(Index i) const {
    const double unit = std::max(static_cast<double>(spacing_.local[i]), spacing_.rho);
    return {cloud_.points[i], support * options_.scale * unit};
  }

  double at(Index i, std::span<const Index> near, std::vector<FourNeighbours>& neighbours) const {
    const double radius = ball(i).radius;
    neighbours.assign((near.size() + 3) / 4, {});
    std::size_t count = 0;
    for (const Index j : near) {
      if (cloud_.normals[j].dot(cloud_.normals[i]) <= 0) continue;
      FourNeighbours& four = neighbours[count / 4];
      const std::size_t lane = count++ % 4;
      const Vec3 d = (cloud_.points[i] - cloud_.points[j]) / radius, n = cloud_.normals[j].cast<double>();
      four.x[lane] = d.x(), four.y[lane] = d.y(), four.z[lane] = d.z();
      four.n_x[lane] = n.x(), four.n_y[lane] = n.y(), four.n_z[lane] = n.z();
    }
    if (count < 6) return 0;
    // Points at a distance of rho from each other cannot resolve a radius of curvature below rho.
    const double k = fitted_curvature(std::span(neighbours).first((count + 3) / 4), radius);
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
    std::vector<FourNeighbours> neighbours;
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
  // Each pass averages over direct neighbours, about rho away. So three passes reach points at a distance of
  // at least 2 rho.
  constexpr int passes = 3;
  const std::vector<Triangle>& triangles = triangulation.triangles;
  const auto own_area = [&](Index i) { return static_cast<double>(normals[i].z()); };
  // Per triangle and corner c: the weight of corner c + 1 in the mean at corner c.
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
