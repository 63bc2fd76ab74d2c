// Computes with vectors, triangles and convex polygons in the plane.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the signed area of the parallelogram of a and b, positive if b is to the left of a. If a and b are
// edges from the same corner of a triangle, this is twice the triangle's signed area.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Returns twice the signed area of a triangle, positive if its corners run counter-clockwise.
inline double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, c - a);
}

// Returns the radius of the circle through the corners of a triangle; infinity if it has no area.
inline double circumradius(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double twice_area = std::abs(cross(u, v));
  const double product = u.norm() * v.norm() * (c - b).norm();
  return twice_area > 0 ? product / (2 * twice_area) : std::numeric_limits<double>::infinity();
}

struct Circle {
  Vec2 centre;
  double radius;
};

// Returns the circle through the corners of a triangle, which must have an area.
inline Circle circle_through(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 p = b - a, q = c - a;
  const double twice = 2 * cross(p, q);
  const Vec2 to_centre = Vec2(q.y() * p.squaredNorm() - p.y() * q.squaredNorm(),
                              p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) /
                         twice;
  return {a + to_centre, to_centre.norm()};
}

// Returns the gradients of a triangle's three hat functions. A hat function is linear, 1 at its own corner
// and 0 at the other two. `twice_area` is twice the triangle's signed area.
inline std::array<Vec2, 3> hat_gradients(const std::array<Vec2, 3>& corners, double twice_area) {
  std::array<Vec2, 3> gradients;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 opposite = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    gradients[i] = Vec2(-opposite.y(), opposite.x()) / twice_area;
  }
  return gradients;
}

// Returns the polygon after every side was moved inwards by `mm`. A negative `mm` moves the sides outwards.
// Sides that become shorter than 0.0001 mm are removed. Neighbouring sides of the polygon must not be
// parallel, and the remaining sides must still enclose an area.
std::vector<Vec2> inset(std::span<const Vec2> polygon, double mm);

// Returns whether `place` is inside the convex polygon and at least `depth` away from its sides.
bool is_within(const Vec2& place, std::span<const Vec2> polygon, double depth = 0);

}  // namespace relievo
