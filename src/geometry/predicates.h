// Computes the exact signs of the two determinants that a Delaunay triangulation depends on.
//
// Each function first evaluates the determinant in doubles. If the value exceeds a proven bound of the rounding
// error, its sign is correct; otherwise the function computes with expansions (Shewchuk, "Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, section 4). There is no state and no
// initialisation, so any thread may call the functions. They are exact if the processor rounds to nearest and each
// coordinate is 0 or has a magnitude between smallest_coordinate and largest_coordinate. The rarest case takes 45 KB
// of stack.
#pragma once

#include <cmath>
#include <limits>

#include "relievo/core/types.h"

namespace relievo {

// Within these limits, products of four coordinates neither overflow nor lose bits to underflow.
inline constexpr double smallest_coordinate = 1e-60, largest_coordinate = 1e70;

inline bool is_exact_coordinate(double x) {
  const double magnitude = std::abs(x);
  return x == 0 || (magnitude >= smallest_coordinate && magnitude <= largest_coordinate);
}

// Returns whether the predicates are exact for the point; false for NaN and infinity.
inline bool is_exact_point(const Vec2& p) {
  return is_exact_coordinate(p.x()) && is_exact_coordinate(p.y());
}

namespace detail {

// Half a unit in the last place of 1: the largest relative error of one operation.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;
inline constexpr double orient2d_bound = (3 + 16 * epsilon) * epsilon;
inline constexpr double incircle_bound = (10 + 96 * epsilon) * epsilon;

int orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c);
int incircle_exact(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace detail

// Returns 1 if a, b, c turn left (counter-clockwise), -1 if they turn right, 0 if they are on one line.
inline int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  const double bound = detail::orient2d_bound * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  return detail::orient2d_exact(a, b, c);
}

// For counter-clockwise a, b, c: returns 1 if d is strictly inside the circle through a, b, c, -1 if strictly
// outside, 0 if on the circle. For clockwise a, b, c the sign is the opposite.
inline int incircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double ax = a.x() - d.x(), ay = a.y() - d.y();
  const double bx = b.x() - d.x(), by = b.y() - d.y();
  const double cx = c.x() - d.x(), cy = c.y() - d.y();
  const double a_lift = ax * ax + ay * ay, b_lift = bx * bx + by * by, c_lift = cx * cx + cy * cy;
  const double bxcy = bx * cy, bycx = by * cx;
  const double cxay = cx * ay, cyax = cy * ax;
  const double axby = ax * by, aybx = ay * bx;
  const double determinant = a_lift * (bxcy - bycx) + b_lift * (cxay - cyax) + c_lift * (axby - aybx);
  const double permanent = a_lift * (std::abs(bxcy) + std::abs(bycx)) +
                           b_lift * (std::abs(cxay) + std::abs(cyax)) +
                           c_lift * (std::abs(axby) + std::abs(aybx));
  const double bound = detail::incircle_bound * permanent;
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  return detail::incircle_exact(a, b, c, d);
}

}  // namespace relievo
