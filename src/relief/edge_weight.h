// The weight of an edge in equation (9): height_equations() sums up the halves, and TriangleSlopes reduces its
// triangles by needle_share(). Whoever changes the weight changes it here and in tests/relief/heights_test.cpp.
#pragma once

#include <algorithm>
#include <span>

#include "geometry/plane.h"
#include "relievo/core/types.h"
#include "relievo/scan/boundary.h"

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

// Returns the factor, in [0, 1], by which edge_weight() reduces a triangle with the largest half weight
// `stiffest`: an edge is the sum of two halves, so that a triangle has half of the bound.
inline double needle_share(double stiffest) {
  constexpr double largest_half = largest_edge_weight / 2;
  return std::min(1.0, largest_half / std::max(stiffest, 1e-300));
}

// Returns the share of its weight that an edge near a depth jump has: the mean of its ends' `weights`, one
// per point, see jump_weights(). Walls at jumps are narrower than the sampling distance, and would tie both
// sides together more than edges between scattered points do; edges across them count a tenth.
inline float jump_share(const Boundary& boundary, std::span<const float> weights, Index a, Index b) {
  const float share = (weights[a] + weights[b]) / 2;
  return boundary.is_across_wall(a, b) ? .1F * share : share;
}

}  // namespace relievo
