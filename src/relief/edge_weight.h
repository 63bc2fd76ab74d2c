// The weight of an edge in equation (9). It is used by the systems of all points and of control points, and
// for the steps at depth jumps. TriangleSlopes needs weights of triangles without factors, so it uses
// half_edge_weight() and needle_share(). tests/support/least_squares.h computes the weight
// independently.
#pragma once

#include <algorithm>
#include <span>

#include "geometry/edges.h"
#include "geometry/plane.h"
#include "relievo/core/types.h"

namespace relievo {

// The largest weight, for edges opposite to very small angles. Beside larger weights all others would be lost
// in single precision.
inline constexpr float largest_edge_weight = 1e3F;
// Cocircular points give weights of 0. This least weight keeps the matrix positive definite for all points.
inline constexpr float least_edge_weight = 1e-4F;

// Returns half the cotangent of a triangle's angle at `apex`, which the triangle adds to the weight of the
// edge from a to b. The corners run counter-clockwise.
inline double half_edge_weight(const Vec2& apex, const Vec2& a, const Vec2& b) {
  const Vec2 u = a - apex, v = b - apex;
  return .5 * std::clamp(u.dot(v) / std::max(cross(u, v), 1e-300), -1e6, 1e6);
}

// Returns the factor, in [0, 1], by which edge_weight() reduces a triangle with the largest half weight
// `stiffest`. The weight of an edge is the sum of two half weights, so half of the bound applies to a
// triangle.
inline double needle_share(double stiffest) {
  constexpr double largest_half = largest_edge_weight / 2;
  return std::min(1.0, largest_half / std::max(stiffest, 1e-300));
}

// Returns the weight of the edge from a to b; `sum` is the sum of its half weights. If `weights` is not empty,
// it has a factor per point, and the edge has the mean of those of its two ends.
inline float edge_weight(float sum, std::span<const float> weights, Index a, Index b) {
  const float weight = std::clamp(sum, least_edge_weight, largest_edge_weight);
  return weights.empty() ? weight : weight * (weights[a] + weights[b]) / 2;
}

// Returns the weight of the edge on which the sides lie, of triangles between points in view coordinates.
inline float edge_weight(std::span<const Vec3> points, std::span<const TriangleSide> sides) {
  const auto plane = [&](Index i) { return Vec2(points[i].head<2>()); };
  float sum = 0;
  for (const TriangleSide& s : sides)
    sum += static_cast<float>(half_edge_weight(plane(s.apex), plane(s.from), plane(s.to)));
  return edge_weight(sum, {}, sides[0].low(), sides[0].high());
}

}  // namespace relievo
