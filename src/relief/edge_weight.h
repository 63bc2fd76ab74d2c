// Computes the weight of an edge in equation (9). The weight is used in the systems of all points and of control
// points, and for the steps at depth jumps. TriangleSlopes uses half_edge_weight() and needle_share(), because its
// weights belong to triangles. tests/support/least_squares.h computes the weight independently.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/edges.h"
#include "geometry/plane.h"
#include "relievo/core/types.h"
#include "relievo/scan/surface.h"

namespace relievo {

// The largest weight, for edges opposite to very small angles. If an edge had a larger weight, single
// precision would lose the other weights of its points.
inline constexpr float largest_edge_weight = 1e3F;
// If two triangles have the same circumcircle, the edge between them would have weight 0. This least weight
// keeps the matrix positive definite.
inline constexpr float least_edge_weight = 1e-4F;

// Returns half the cotangent of a triangle's angle at `apex`. This is the triangle's contribution to the
// weight of the edge from a to b. The corners run counter-clockwise.
inline double half_edge_weight(const Vec2& apex, const Vec2& a, const Vec2& b) {
  const Vec2 u = a - apex, v = b - apex;
  return .5 * std::clamp(u.dot(v) / std::max(cross(u, v), 1e-300), -1e6, 1e6);
}

// Returns the factor, in [0, 1], for all half weights of a triangle. `stiffest` is the largest of these
// weights. The factor reduces it to at most half of largest_edge_weight, because the weight of an edge is the
// sum of two half weights.
inline double needle_share(double stiffest) {
  constexpr double largest_half = largest_edge_weight / 2;
  return std::min(1.0, largest_half / std::max(stiffest, 1e-300));
}

// Returns the weight of the edge from a to b. `sum` is the sum of its half weights. `weights` has a factor
// per point or is empty. The edge's weight is multiplied by the mean factor of both ends.
inline float edge_weight(float sum, std::span<const float> weights, Index a, Index b) {
  const float weight = std::clamp(sum, least_edge_weight, largest_edge_weight);
  return weights.empty() ? weight : weight * (weights[a] + weights[b]) / 2;
}

// Returns the weight of the edge to which the triangle sides `sides` belong. `points` are in view coordinates.
inline float edge_weight(std::span<const Vec3> points, std::span<const TriangleSide> sides) {
  const auto plane = [&](Index i) { return Vec2(points[i].head<2>()); };
  float sum = 0;
  for (const TriangleSide& s : sides)
    sum += static_cast<float>(half_edge_weight(plane(s.apex), plane(s.from), plane(s.to)));
  return edge_weight(sum, {}, sides[0].low(), sides[0].high());
}

// An edge of a surface, from the point with the lower index, and its weight.
struct WeightedLink {
  Index a, b;
  float weight;
};

// Returns the edges with a triangle side for which is_wanted(side) is true, in the order of each_edge().
template <typename IsWanted>
std::vector<WeightedLink> weighted_links(const Surface& surface, IsWanted&& is_wanted) {
  std::vector<WeightedLink> links;
  each_edge(surface.triangulation.triangles, is_wanted, [&](std::span<const TriangleSide> sides) {
    links.push_back({sides[0].low(), sides[0].high(), edge_weight(surface.points, sides)});
  });
  return links;
}

}  // namespace relievo
