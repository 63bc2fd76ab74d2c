#include "relievo/scan/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/disjoint_sets.h"
#include "geometry/neighbours.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"
#include "scan/scan_limits.h"

namespace relievo {
namespace {

// If the empty circle (the circumcircle) of a triangle has a radius of more than 3 rho (rho is the sampling
// distance), the triangle spans a gap and is outside the relief. Smaller circles are due to sampling.
constexpr double gap = 3;

// Returns the unit for the radius of a triangle's empty circle: rho or, if all three corners are sparse, the smallest
// of their local spacings.
double spacing_at(const Triangle& t, double rho, std::span<const float> spacing) {
  constexpr double sparse = 2;  // in rho; a corner with a larger local spacing is sparse
  if (spacing.empty()) return rho;
  const auto least = static_cast<double>(std::min({spacing[t[0]], spacing[t[1]], spacing[t[2]]}));
  return least > sparse * rho ? least : rho;
}

// Marks narrow holes as inside. A hole is a connected set of outside triangles that does not touch the hull. It is
// narrow if the largest empty circle in it is not larger than ScanLimits::largest_hole. `radius` has the radii of the
// triangles' empty circles, in sampling distances.
void close_narrow_holes(const Triangulation& mesh, std::span<const double> radius,
                        std::vector<std::uint8_t>& is_inside) {
  DisjointSets sets(is_inside.size());
  for (Index t = 0; t < is_inside.size(); ++t)
    for (const Index other : mesh.neighbours[t])
      if (other != no_index && !is_inside[t] && !is_inside[other]) sets.join(t, other);
  std::vector<std::uint8_t> stays_outside(is_inside.size(), 0);
  for (Index t = 0; t < is_inside.size(); ++t) {
    const bool is_open = std::ranges::find(mesh.neighbours[t], no_index) != mesh.neighbours[t].end();
    if (!is_inside[t] && (is_open || radius[t] > ScanLimits::largest_hole)) stays_outside[sets.find(t)] = 1;
  }
  for (Index t = 0; t < is_inside.size(); ++t)
    if (!is_inside[t]) is_inside[t] = !stays_outside[sets.find(t)];
}

}  // namespace

std::vector<std::uint8_t> boundary_points(std::size_t points, const Triangulation& triangulation,
                                          std::span<const std::uint8_t> is_inside) {
  std::vector<std::uint8_t> touches_inside(points, 0), is_boundary(points, 0);
  for (std::size_t t = 0; t < is_inside.size(); ++t)
    for (const Index corner : triangulation.triangles[t])
      (is_inside[t] ? touches_inside : is_boundary)[corner] = 1;
  for (const Index i : triangulation.hull) is_boundary[i] = 1;
  for (std::size_t i = 0; i < points; ++i) is_boundary[i] |= !touches_inside[i];
  return is_boundary;
}

std::vector<float> distances_to(std::span<const Vec2> points, const std::vector<std::uint8_t>& is_boundary) {
  std::vector<Vec2> targets;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_boundary[i]) targets.push_back(points[i]);
  const KdTree<Vec2> tree(targets);
  std::vector<float> distance(points.size(), std::numeric_limits<float>::infinity());
  parallel_for(points.size(), [&](std::size_t i) {
    Index nearest;
    double distance_sq;
    if (tree.nearest(points[i], 1, &nearest, &distance_sq))
      distance[i] = static_cast<float>(std::sqrt(distance_sq));
  });
  return distance;
}

std::vector<std::uint8_t> inside_triangles(std::span<const Vec2> points, const Triangulation& triangulation,
                                           double rho, std::span<const float> spacing) {
  std::vector<double> radius(triangulation.triangles.size());
  std::vector<std::uint8_t> is_inside(radius.size());
  parallel_for(radius.size(), [&](std::size_t t) {
    const Triangle& corners = triangulation.triangles[t];
    const auto& [a, b, c] = corners;
    radius[t] = circumradius(points[a], points[b], points[c]) / spacing_at(corners, rho, spacing);
    is_inside[t] = radius[t] <= gap;
  });
  close_narrow_holes(triangulation, radius, is_inside);
  return is_inside;
}

Boundary find_boundary(std::span<const Vec2> points, const Triangulation& triangulation, double rho) {
  Boundary boundary;
  boundary.is_inside = inside_triangles(points, triangulation, rho);
  boundary.is_boundary = boundary_points(points.size(), triangulation, boundary.is_inside);
  boundary.distance = distances_to(points, boundary.is_boundary);
  return boundary;
}

}  // namespace relievo
