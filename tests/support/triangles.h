// Computes areas of triangles in the plane, and heights over them, by testing all triangles.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "geometry/plane.h"
#include "relievo/scan/boundary.h"

namespace relievo::test {

// Returns twice the signed area of a triangle in the plane. Its corners may have two or three coordinates.
template <typename Point>
double twice_area(const Point& a, const Point& b, const Point& c) {
  return cross(Vec2((b - a).template head<2>()), Vec2((c - a).template head<2>()));
}

// Returns the sum of the signed areas of triangles in the plane.
template <typename Point>
double area_of(const std::vector<Point>& points, std::span<const Triangle> triangles) {
  double twice = 0;
  for (const auto& [a, b, c] : triangles) twice += twice_area(points[a], points[b], points[c]);
  return twice / 2;
}

// Returns the sum of the signed areas of the triangles inside the boundary.
template <typename Point>
double inside_area(const std::vector<Point>& points, const Triangulation& mesh, const Boundary& boundary) {
  std::vector<Triangle> inside;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (boundary.is_inside[t]) inside.push_back(mesh.triangles[t]);
  return area_of(points, inside);
}

template <typename Point>
void expect_counter_clockwise(const std::vector<Point>& points, std::span<const Triangle> triangles) {
  for (const auto& [a, b, c] : triangles)
    EXPECT_GT(twice_area(points[a], points[b], points[c]), 0) << a << ' ' << b << ' ' << c;
}

// Returns the height of the first triangle that is above or below a point; NaN if there is none.
inline double height_at(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                        const Vec2& place) {
  for (const auto& [a, b, c] : triangles) {
    const Vec2 p = points[a].head<2>(), q = points[b].head<2>(), r = points[c].head<2>();
    const Vec3 weights(twice_area(place, q, r), twice_area(place, r, p), twice_area(place, p, q));
    if (weights.minCoeff() >= 0 && weights.sum() > 0)
      return weights.dot(Vec3(points[a].z(), points[b].z(), points[c].z())) / weights.sum();
  }
  return std::nan("");
}

}  // namespace relievo::test
