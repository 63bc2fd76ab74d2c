#include "relief/triangle_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/plane.h"
#include "relief/edge_weight.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns the weight of a triangle: its area, reduced for needles as (9) reduces their edges.
double weight_of(const std::array<Vec2, 3>& p) {
  const double area = cross(p[1] - p[0], p[2] - p[0]) / 2;
  double stiffest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    stiffest = std::max(stiffest, half_edge_weight(p[i], p[(i + 1) % 3], p[(i + 2) % 3]));
  return area * needle_share(stiffest);
}

}  // namespace

TriangleSlopes::TriangleSlopes(std::span<const Vec2> points, const Triangulation& triangulation,
                               const Boundary& boundary) {
  const auto is_free = [&](Index i) { return !boundary.is_boundary[i]; };
  begin_.assign(points.size() + 1, 0);
  for (std::size_t t = 0; t < triangulation.triangles.size(); ++t) {
    const Triangle& corners = triangulation.triangles[t];
    if (!boundary.is_inside[t] || std::ranges::none_of(corners, is_free)) continue;
    triangles_.push_back({corners});
    for (const Index i : corners)
      if (is_free(i)) ++begin_[i + 1];
  }
  for (std::size_t i = 0; i < points.size(); ++i) begin_[i + 1] += begin_[i];
  shares_.resize(begin_.back());
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& corners = triangles_[t].corners;
    const std::array<Vec2, 3> p{points[corners[0]], points[corners[1]], points[corners[2]]};
    const std::array<Vec2, 3> gradients = hat_gradients(p, std::max(cross(p[1] - p[0], p[2] - p[0]), 1e-300));
    triangles_[t].first = gradients[0].cast<float>();
    triangles_[t].second = gradients[1].cast<float>();
    const double weight = weight_of(p);
    for (std::size_t i = 0; i < 3; ++i)
      if (is_free(corners[i]))
        shares_[next[corners[i]]++] = {static_cast<Index>(t), (weight * gradients[i]).cast<float>()};
  }
}

void TriangleSlopes::divergence(std::span<const Vec2f> field, std::span<float> sums) const {
  parallel_for(sums.size(), [&](std::size_t i) {
    float sum = 0;
    for (Index s = begin_[i]; s < begin_[i + 1]; ++s)
      sum += shares_[s].weight.dot(field[shares_[s].triangle]);
    sums[i] = sum;
  });
}

}  // namespace relievo
