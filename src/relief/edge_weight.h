// The weight of an edge in equation (9). Whoever changes it changes it here: height_equations() sums up the
// halves, and TriangleSlopes limits its triangles by half the bound.
#pragma once

#include <algorithm>

#include "geometry/plane.h"
#include "relievo/core/types.h"

namespace relievo {

// Edges opposite to very small angles are cut here: stiffer ones would drown the others in single precision.
inline constexpr float largest_edge_weight = 1e3F;
// Cocircular points give weights of 0; a trace of stiffness keeps the matrix positive definite whatever the
// points are.
inline constexpr float least_edge_weight = 1e-4F;

// Returns half the cotangent of a triangle's angle at `apex`: what the triangle adds to the weight of the edge
// from a to b. The corners run counter-clockwise.
inline double half_edge_weight(const Vec2& apex, const Vec2& a, const Vec2& b) {
  const Vec2 u = a - apex, v = b - apex;
  return .5 * std::clamp(u.dot(v) / std::max(cross(u, v), 1e-300), -1e6, 1e6);
}

// Returns the weight of an edge whose triangles add up to `sum`.
inline float edge_weight(float sum) {
  return std::clamp(sum, least_edge_weight, largest_edge_weight);
}

}  // namespace relievo
