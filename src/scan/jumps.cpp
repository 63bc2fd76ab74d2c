#include "scan/jumps.h"

#include <algorithm>
#include <cmath>

#include "geometry/neighbours.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns how far a tangent plane rises along a step. n_z is limited to 0.1, because near the silhouette the
// plane is too steep to distinguish a jump from a slope.
double rise(const Vec3f& normal, const Vec2& step) {
  const Vec3 n = normal.cast<double>();
  return std::abs(n.head<2>().dot(step)) / std::max(n.z(), .1);
}

// The weight of edges at a jump in (9). docs/decisions/jumps.md shows the effect of other values.
constexpr double least_weight = .2;
// In shares of the surface's longer side: the distance from a jump at which edges count fully, and the least
// height of a jump. Lower jumps leave little misfit, and may be noise.
constexpr double full_weight_distance = .008, least_jump_height = .02;

double depth_range(const Surface& surface, const Triangle& t) {
  const auto [low, high] =
      std::minmax({surface.points[t[0]].z(), surface.points[t[1]].z(), surface.points[t[2]].z()});
  return high - low;
}

std::vector<Vec2> points_at_high_jumps(const Surface& surface, double least_height) {
  const std::vector<std::uint8_t> jumps = jump_triangles(surface);
  std::vector<std::uint8_t> marks(surface.points.size());
  for (std::size_t t = 0; t < jumps.size(); ++t) {
    const Triangle& corners = surface.triangulation.triangles[t];
    if (!jumps[t] || depth_range(surface, corners) < least_height) continue;
    for (const Index p : corners) marks[p] = 1;
  }
  std::vector<Vec2> marked;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) marked.push_back(surface.points[i].head<2>());
  return marked;
}

}  // namespace

bool is_jump(const Surface& surface, Index a, Index b) {
  const Vec3 step = surface.points[b] - surface.points[a];
  const double rises =
      std::max(rise(surface.normals[a], step.head<2>()), rise(surface.normals[b], step.head<2>()));
  return std::abs(step.z()) > 2 * rises + 3 * surface.rho;
}

std::vector<std::uint8_t> jump_triangles(const Surface& surface) {
  std::vector<std::uint8_t> is_jumping(surface.triangulation.triangles.size());
  parallel_for(is_jumping.size(), [&](std::size_t t) {
    const auto [a, b, c] = surface.triangulation.triangles[t];
    is_jumping[t] = surface.boundary.is_inside[t] &&
                    (is_jump(surface, a, b) || is_jump(surface, b, c) || is_jump(surface, c, a));
  });
  return is_jumping;
}

std::vector<float> jump_weights(const Surface& surface) {
  const double side = surface.longer_side(), full_distance = full_weight_distance * side;
  const std::vector<Vec2> jumps = points_at_high_jumps(surface, least_jump_height * side);
  const KdTree<Vec2> tree(jumps);
  std::vector<float> weights(surface.points.size(), 1);
  parallel_for(weights.size(), [&](std::size_t i) {
    Index nearest;
    double distance_sq;
    if (!tree.nearest(surface.points[i].head<2>(), 1, &nearest, &distance_sq)) return;
    const double share = std::min(std::sqrt(distance_sq) / full_distance, 1.0);
    weights[i] = static_cast<float>(std::pow(least_weight, 1 - share));
  });
  return weights;
}

}  // namespace relievo
