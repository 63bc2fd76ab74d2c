#include "relief/nearest_draft.h"

#include <algorithm>
#include <array>

#include "core/lists.h"
#include "geometry/plane.h"
#include "relief/edge_weight.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns the weight of a triangle: its area times needle_share(), which is less than 1 only for triangles
// with a very small angle.
double weight_of(const std::array<Vec2, 3>& p) {
  const double area = cross(p[1] - p[0], p[2] - p[0]) / 2;
  double stiffest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    stiffest = std::max(stiffest, half_edge_weight(p[i], p[(i + 1) % 3], p[(i + 2) % 3]));
  return area * needle_share(stiffest);
}

// The penalty parameter and the over-relaxation of ADMM. With these values, scans took the fewest iterations: 20 to 60.
constexpr float penalty = 10, relaxation = 1.7F;
// Target slopes are shortened to this many times the limit. Otherwise walls at depth jumps, which may be
// arbitrarily steep, would dominate the least squares.
constexpr float steepest_given = 2;

// The iteration stops when at most 1 in 5,000 triangles exceeds the limit by more than 0.4 %; limit_slopes()
// corrects these locally.
constexpr float good_excess = 1.004F;
constexpr std::size_t good_divisor = 5000;

}  // namespace

NearestDraft::NearestDraft(const Surface& surface, const HeightSystem& system, std::span<const double> base,
                           double max_slope)
    : system_(system),
      triangles_(in_plane(surface.points), surface.triangulation, surface.boundary),
      max_slope_(static_cast<float>(max_slope)),
      workspace_(system.make_workspace()),
      given_(triangles_.size()),
      counted_(triangles_.size()),
      projected_(triangles_.size()),
      dual_(triangles_.size(), Vec2f::Zero()),
      field_(triangles_.size()),
      first_(surface.points.size()),
      heights_(surface.points.size()),
      change_(surface.points.size()) {
  if (base.empty()) return;
  base_.resize(triangles_.size());
  parallel_for(base_.size(), [&](std::size_t t) { base_[t] = triangles_.slope(t, base).cast<float>(); });
}

void NearestDraft::begin(std::span<const double> heights) {
  for (std::size_t i = 0; i < heights.size(); ++i) first_[i] = heights_[i] = static_cast<float>(heights[i]);
  parallel_for(given_.size(), [&](std::size_t t) {
    given_[t] = triangles_.slope(t, std::span<const float>(first_));
    counted_[t] = projected(given_[t], t, steepest_given * max_slope_);
    if (!is_started_) projected_[t] = given_[t];
  });
  is_started_ = true;
}

Vec2f NearestDraft::projected(const Vec2f& slope, std::size_t triangle, float steepest) const {
  const Vec2f base = base_.empty() ? Vec2f(Vec2f::Zero()) : base_[triangle];
  const Vec2f whole = slope + base;
  const float length = whole.norm();
  return length > steepest ? Vec2f(whole * (steepest / length) - base) : slope;
}

void NearestDraft::step() {
  parallel_for(projected_.size(), [&](std::size_t t) {
    const Vec2f now = triangles_.slope(t, std::span<const float>(heights_));
    const Vec2f wish = relaxation * now + (1 - relaxation) * projected_[t] + dual_[t];
    projected_[t] = projected(wish, t, max_slope_);
    dual_[t] = wish - projected_[t];
    field_[t] = (counted_[t] + penalty * (projected_[t] - dual_[t])) / (1 + penalty) - given_[t];
  });
  triangles_.divergence(field_, change_);
  system_.solve_in_place(change_, workspace_);
  parallel_for(heights_.size(), [&](std::size_t i) { heights_[i] = first_[i] + change_[i]; });
}

bool NearestDraft::is_good() const {
  const std::size_t steep = count_where(triangles_.size(), [&](std::size_t t) {
    Vec2f slope = triangles_.slope(t, std::span<const float>(heights_));
    if (!base_.empty()) slope += base_[t];
    return slope.norm() > good_excess * max_slope_;
  });
  return steep <= triangles_.size() / good_divisor;
}

void NearestDraft::end(std::span<double> heights) const {
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += static_cast<double>(change_[i]);
}

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
