#include "scan/outlines/notches.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "relievo/core/parallel.h"
#include "scan/outlines/outlines.h"

namespace relievo {
namespace {

// The radius, in rho, of the largest empty circle that sampling leaves where a surface is seen edge on;
// points are dense there.
constexpr double widest_circle = 1.2;
// The length of a normal's x and y above which its surface turns away from the viewer, as in outlines.cpp.
constexpr double least_turned = .75;

double circle_radius(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double twice_area = std::abs(cross(b - a, c - a));
  return (b - a).norm() * (c - b).norm() * (a - c).norm() / std::max(2 * twice_area, 1e-300);
}

// Returns whether a depth jump lies between two points and the surface behind ends there: its normal leans
// towards the point in front.
bool ends_at_jump(const Surface& surface, Index front, Index back) {
  if (!is_occlusion(surface, front, back)) return false;
  if (surface.points[front].z() < surface.points[back].z()) std::swap(front, back);
  const Vec2 step = (surface.points[front] - surface.points[back]).head<2>();
  return surface.normals[back].head<2>().cast<double>().dot(step) > least_turned * step.norm();
}

std::vector<std::uint8_t> gap_triangles(const Surface& surface) {
  const std::vector<Triangle>& triangles = surface.triangulation.triangles;
  std::vector<std::uint8_t> is_gap(triangles.size(), 0);
  parallel_for(triangles.size(), [&](std::size_t t) {
    if (!surface.boundary.is_inside[t]) return;
    const auto [a, b, c] = triangles[t];
    const auto at = [&](Index i) -> Vec2 { return surface.points[i].head<2>(); };
    is_gap[t] = circle_radius(at(a), at(b), at(c)) > widest_circle * surface.rho &&
                (ends_at_jump(surface, a, b) || ends_at_jump(surface, b, c) || ends_at_jump(surface, c, a));
  });
  return is_gap;
}

}  // namespace

void open_notches(Surface& surface) {
  std::vector<std::uint8_t>& is_inside = surface.boundary.is_inside;
  const std::vector<std::uint8_t> is_gap = gap_triangles(surface);
  std::vector<Index> open;
  for (Index t = 0; t < is_inside.size(); ++t)
    if (!is_inside[t]) open.push_back(t);
  while (!open.empty()) {
    const Index t = open.back();
    open.pop_back();
    for (const Index other : surface.triangulation.neighbours[t])
      if (other != no_index && is_inside[other] && is_gap[other]) is_inside[other] = 0, open.push_back(other);
  }
}

}  // namespace relievo
