#include "scan/outlines/outlines.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Lengths in rho, the sampling distance.
constexpr double grid_cell = 1.5;
constexpr double most_distant = 1.5;   // largest distance of the exact outline from the sampled one
constexpr double node_spacing = .25;   // distance between nodes; small, because nodes are exact
constexpr double curve_spacing = .75;  // distance between points of the fair curve
// The window of the fair curve, see FairCurveOptions. Nodes are missing at turns of the sampled outline,
// where the exact outline has another direction. The window is wide enough to bridge these gaps.
constexpr double exact_window = 1;
// Largest distance by which a point of the curve is moved onto the exact outline.
constexpr double most_moved = .5;
constexpr double least_spacing = .2;  // between moved points of the curve; closer ones are left out
// The least length of an edge across a gap. Samples of a surface without gaps are closer together, even
// diagonally across their grid.
constexpr double least_gap = 1.7;

std::vector<Segment> plane_segments(std::span<const OutlineSegment> segments, bool is_jump) {
  std::vector<Segment> plane;
  for (const OutlineSegment& s : segments)
    if (s.is_jump == is_jump) plane.push_back({s.from.head<2>(), s.to.head<2>()});
  return plane;
}

Vec2 nearest_place(const Segment& s, const Vec2& place) {
  const Vec2 step = s.to - s.from;
  return s.from + std::clamp((place - s.from).dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
}

}  // namespace

ExactOutlines::ExactOutlines(std::span<const OutlineSegment> segments, double rho)
    : rho_(rho),
      silhouettes_(plane_segments(segments, false), grid_cell * rho),
      jumps_(plane_segments(segments, true), grid_cell * rho) {}

void ExactOutlines::open_gaps(Surface& surface) const {
  if (silhouettes_.segments().empty()) return;
  const auto& triangles = surface.triangulation.triangles;
  parallel_for(triangles.size(), [&](std::size_t t) {
    if (!surface.boundary.is_inside[t]) return;
    const auto at = [&](std::size_t i) -> Vec2 { return surface.points[triangles[t][i % 3]].head<2>(); };
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, (at(i + 1) - at(i)).norm());
    if (longest < least_gap * rho_) return;
    const NearestSegment near = silhouettes_.nearest((at(0) + at(1) + at(2)) / 3, longest);
    if (near.segment != no_index && !near.is_left) surface.boundary.is_inside[t] = 0;
  });
}

std::optional<Vec2> ExactOutlines::nearest(const Vec2& place, double radius, const Vec2& direction,
                                           bool is_jump) const {
  const auto on = [&](const SegmentGrid& grid) -> std::optional<Vec2> {
    const NearestSegment near = grid.nearest_along(place, radius, direction);
    if (near.segment == no_index) return std::nullopt;
    return nearest_place(grid.segments()[near.segment], place);
  };
  if (is_jump) return on(jumps_);
  const std::optional<Vec2> silhouette = on(silhouettes_);
  return silhouette ? silhouette : on(jumps_);
}

bool ExactOutlines::add_nodes(std::span<const Vec2> places, std::size_t i, bool is_closed, bool is_jump,
                              std::vector<CurveNode>& nodes) const {
  const std::size_t n = places.size();
  const auto around = [&](std::ptrdiff_t step) -> const Vec2& {
    const auto k = static_cast<std::ptrdiff_t>(i) + step, size = static_cast<std::ptrdiff_t>(n);
    return places[static_cast<std::size_t>(is_closed ? ((k % size) + size) % size
                                                     : std::clamp<std::ptrdiff_t>(k, 0, size - 1))];
  };
  const Vec2 direction = (around(3) - around(-2)).normalized();
  const bool is_last = i + 1 == n && !is_closed;
  const Vec2 step = is_last ? Vec2(0, 0) : Vec2(around(1) - places[i]);
  const int parts = std::max(1, static_cast<int>(std::ceil(step.norm() / (node_spacing * rho_))));
  bool is_first_found = false;
  for (int k = 0; k < parts; ++k) {
    const Vec2 place = places[i] + static_cast<double>(k) / parts * step;
    const std::optional<Vec2> exact = nearest(place, most_distant * rho_, direction, is_jump);
    if (!exact) continue;
    is_first_found |= k == 0;
    nodes.push_back({*exact});
  }
  return is_first_found;
}

FairCurve ExactOutlines::on_outline(std::span<const CurveNode> nodes, bool is_closed, bool is_jump) const {
  const FairCurve fair = fair_curve(nodes, is_closed, {curve_spacing * rho_, exact_window * rho_});
  FairCurve exact;
  const std::size_t n = fair.points.size();
  for (std::size_t k = 0; k < n; ++k) {
    Vec2 place = fair.points[k];
    if (!fair.is_corner[k]) {
      const Vec2 &before = fair.points[k > 0 || !is_closed ? std::max<std::size_t>(k, 1) - 1 : n - 1],
                 &after = fair.points[is_closed ? (k + 1) % n : std::min(k + 1, n - 1)];
      place = nearest(place, most_moved * rho_, (after - before).normalized(), is_jump).value_or(place);
      if (k > 0 && (place - exact.points.back()).norm() < least_spacing * rho_) continue;
    }
    exact.points.push_back(place);
    exact.is_corner.push_back(fair.is_corner[k]);
  }
  return exact;
}

}  // namespace relievo
