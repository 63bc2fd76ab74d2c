#include "relief/baselines/normal_layers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/groups.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// Returns the neighbours of each point. A neighbour is listed twice if the edge to it has two triangles.
Groups<Index> neighbours_of(const Surface& surface) {
  const std::vector<std::uint8_t> is_jump = jump_triangles(surface);
  return grouped<Index>(surface.points.size(), [&](auto&& add) {
    for (std::size_t t = 0; t < is_jump.size(); ++t) {
      if (!surface.boundary.is_inside[t] || is_jump[t]) continue;
      const auto [a, b, c] = surface.triangulation.triangles[t];
      add(a, b), add(a, c), add(b, c), add(b, a), add(c, a), add(c, b);
    }
  });
}

// Returns the weight of a neighbour's normal: Tukey's biweight, which is 0 if the normals are more than 40
// degrees apart.
float likeness(const Vec3f& a, const Vec3f& b) {
  constexpr float largest_sq = .468F;  // square of the distance of unit vectors 40 degrees apart
  const float rest = std::max(0.F, 1 - (a - b).squaredNorm() / largest_sq);
  return rest * rest;
}

Eigen::Quaternionf share_of_turn(const Vec3f& from, const Vec3f& to, double share) {
  return Eigen::Quaternionf::Identity().slerp(static_cast<float>(share),
                                              Eigen::Quaternionf::FromTwoVectors(from, to));
}

}  // namespace

std::vector<Vec3f> base_normals(const Surface& surface, double scale) {
  const Groups<Index> neighbours = neighbours_of(surface);
  // One pass averages the point and six neighbours 1.07 rho away. The weights of this mean have a variance of
  // 0.49 rho^2 along each axis.
  const double sigma = scale * surface.longer_side() / surface.rho;
  const auto passes = static_cast<int>(std::ceil(sigma * sigma / .49));
  std::vector<Vec3f> normals = surface.normals, last;
  for (int pass = 0; pass < passes; ++pass) {
    last = normals;
    parallel_for(normals.size(), [&](std::size_t i) {
      Vec3f sum = 2 * last[i];
      for (const Index other : neighbours[i]) sum += likeness(last[i], last[other]) * last[other];
      normals[i] = sum.normalized();
    });
  }
  return normals;
}

Vec3f weighted_normal(const Vec3f& normal, const Vec3f& base, const NormalLayerWeights& weights) {
  const Vec3f view = Vec3f::UnitZ();
  const Vec3f kept = share_of_turn(base, normal, weights.detail) * base;
  return share_of_turn(base, view, 1 - weights.base) * kept;
}

}  // namespace relievo
