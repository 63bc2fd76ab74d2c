#include "relievo/scan/resample.h"

#include <algorithm>

#include "geometry/neighbours.h"
#include "geometry/plane.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// Returns the barycentric weights of a triangle's corners at p; a weight is negative if p is outside.
Vec3 barycentric(const std::array<Vec2, 3>& corner, const Vec2& p) {
  const Vec2 a = corner[0] - p, b = corner[1] - p, c = corner[2] - p;
  const Vec3 areas(cross(b, c), cross(c, a), cross(a, b));
  return areas / std::max(areas.sum(), 1e-300);
}

}  // namespace

std::vector<double> resampled(std::span<const double> heights, const Surface& from, const Surface& to) {
  const Vec3 shift = to.view.R_view_model * (to.centre - from.centre);
  std::vector<Vec2> places = in_plane(to.points);
  for (Vec2& p : places) p += shift.head<2>();
  const KdTree<Vec2> tree(places);
  std::vector<KdTree<Vec2>::Match> near;
  std::vector<double> result(places.size(), 0.0);
  constexpr double rounding = 1e-9;
  for (const Triangle triangle : triangles_inside(from)) {
    std::array<Vec2, 3> corner;
    for (std::size_t c = 0; c < 3; ++c) corner[c] = from.points[triangle[c]].head<2>();
    const Vec2 middle = (corner[0] + corner[1] + corner[2]) / 3;
    double radius = 0;
    for (const Vec2& each : corner) radius = std::max(radius, (each - middle).norm());
    tree.within(middle, radius * (1 + rounding), near);
    for (const auto& [p, distance_sq] : near) {
      const Vec3 weight = barycentric(corner, places[p]);
      if (weight.minCoeff() < -rounding) continue;
      result[p] = weight.x() * heights[triangle[0]] + weight.y() * heights[triangle[1]] +
                  weight.z() * heights[triangle[2]];
    }
  }
  return result;
}

}  // namespace relievo
