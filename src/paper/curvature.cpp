#include "paper/curvature.h"

#include <algorithm>
#include <cmath>

#include "geometry/neighbours.h"
#include "paper/jet.h"
#include "relievo/core/parallel.h"

namespace relievo::paper {
namespace {

constexpr double h_in_rho = 3, radius_in_h = 3;
constexpr double least_curvature = 1e-6;  // in 1 / rho

struct Neighbour {
  Vec3 offset;  // x - q
  Vec3 normal;
};

// Returns theta(x, q), the Gaussian weight of a neighbour.
Jet weight(const Vec3& offset, double h) {
  const double scale = -2 / (h * h), value = std::exp(-offset.squaredNorm() / (h * h));
  return {value, scale * value * offset,
          value * (scale * scale * offset * offset.transpose() + scale * Mat3::Identity())};
}

// Returns n(x), the weighted mean of the neighbours' normals, normalised.
JetVector mean_normal(std::span<const Neighbour> neighbours, double h) {
  JetVector sum;
  for (const Neighbour& q : neighbours) {
    const Jet theta = weight(q.offset, h);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += q.normal[static_cast<Eigen::Index>(i)] * theta;
  }
  Jet square;
  for (const Jet& each : sum) square += each * each;
  const double inverse = 1 / std::sqrt(square.value), cube = inverse * inverse * inverse;
  const Jet scale = chain({inverse, -cube / 2, .75 * cube * inverse * inverse}, square);
  for (Jet& each : sum) each = scale * each;
  return sum;
}

// Equation (2): g(x) = n(x)^T (de(y, n(x)) / dy at y = x), where e is the sum of
// ((y - q)^T n(x))^2 theta(y, q). With d = (x - q)^T n(x), the derivative of each term is
// 2 theta d (n - d (x - q) / h^2); its product with n, of length 1, is 2 theta (d - d^3 / h^2).
Jet surface_function(std::span<const Neighbour> neighbours, double h) {
  const JetVector n = mean_normal(neighbours, h);
  const double inverse = 1 / (h * h);
  Jet g;
  for (const Neighbour& q : neighbours) {
    const Jet distance = dot(q.offset, n);
    const double d = distance.value;
    const Jet term =
        chain({2 * (d - d * d * d * inverse), 2 - 6 * d * d * inverse, -12 * d * inverse}, distance);
    g += weight(q.offset, h) * term;
  }
  return g;
}

// Returns the result of equation (3), divided by -2.
double mean_curvature(const Jet& g) {
  const Vec3& v = g.gradient;
  const double length = v.norm();
  if (!(length > 0)) return 0;
  const double numerator = v.dot(g.hessian * v) - length * length * g.hessian.trace();
  return -numerator / (2 * length * length * length);
}

}  // namespace

std::vector<double> mean_curvature(const Cloud& cloud, double rho, std::span<const Index> queries,
                                   const Progress* progress) {
  const double h = h_in_rho * rho;
  const KdTree<Vec3> tree(cloud.points);
  std::vector<double> k(queries.size(), 0.0);
  parallel_ranges(queries.size(), 1024, [&](std::size_t begin, std::size_t end) {
    if (progress && progress->is_cancelled()) return;
    std::vector<KdTree<Vec3>::Match> matches;
    std::vector<Neighbour> neighbours;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& x = cloud.points[queries[i]];
      tree.within(x, radius_in_h * h, matches);
      neighbours.clear();
      for (const auto& [q, distance_sq] : matches)
        neighbours.push_back({x - cloud.points[q], cloud.normals[q].cast<double>()});
      k[i] = mean_curvature(surface_function(neighbours, h));
    }
  });
  if (std::ranges::all_of(k, [&](double each) { return std::abs(each) * rho < least_curvature; }))
    std::ranges::fill(k, 0.0);
  return k;
}

}  // namespace relievo::paper
