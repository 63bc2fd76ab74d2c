#include "scan/jumps.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns how much a tangent plane rises along a step. n_z is limited to at least 0.1, because near the
// silhouette the plane is too steep to distinguish a jump from a slope.
double rise(const Vec3f& normal, const Vec2& step) {
  const Vec3 n = normal.cast<double>();
  return std::abs(n.head<2>().dot(step)) / std::max(n.z(), .1);
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

}  // namespace relievo
