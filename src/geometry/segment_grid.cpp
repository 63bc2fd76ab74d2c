#include "geometry/segment_grid.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"

namespace relievo {
namespace {

// The largest number of cells along the longer side of the grid. Curves that would need more get larger
// cells.
constexpr double most_cells = 4096;

}  // namespace

SegmentGrid::SegmentGrid(std::vector<Segment> segments, double cell)
    : segments_(std::move(segments)), cell_(cell) {
  if (segments_.empty()) return;
  Vec2 low = segments_[0].from, high = low;
  for (const Segment& s : segments_) {
    low = low.cwiseMin(s.from).cwiseMin(s.to);
    high = high.cwiseMax(s.from).cwiseMax(s.to);
  }
  origin_ = low;
  cell_ = std::max(cell_, (high - low).maxCoeff() / most_cells);
  width_ = static_cast<int>((high.x() - low.x()) / cell_) + 1;
  height_ = static_cast<int>((high.y() - low.y()) / cell_) + 1;
  in_cell_ = grouped<Index, std::size_t>(static_cast<std::size_t>(width_) * height_, [&](auto&& add) {
    for (Index i = 0; i < segments_.size(); ++i) {
      const Segment& s = segments_[i];
      const Cells c = cells_of(s.from.cwiseMin(s.to), s.from.cwiseMax(s.to));
      for (int y = c.y0; y <= c.y1; ++y)
        for (int x = c.x0; x <= c.x1; ++x) add(static_cast<std::size_t>(y) * width_ + x, i);
    }
  });
}

SegmentGrid::Cells SegmentGrid::cells_of(const Vec2& low, const Vec2& high) const {
  const auto at = [&](double v, double origin, int count) {
    return static_cast<int>(std::clamp((v - origin) / cell_, -1.0, static_cast<double>(count)));
  };
  return {std::max(0, at(low.x(), origin_.x(), width_)), std::max(0, at(low.y(), origin_.y(), height_)),
          std::min(width_ - 1, at(high.x(), origin_.x(), width_)),
          std::min(height_ - 1, at(high.y(), origin_.y(), height_))};
}

NearestSegment SegmentGrid::nearest(const Vec2& place, double radius, Index except) const {
  return nearest_of(place, radius, [&](const Segment& s) { return s.curve != except; });
}

NearestSegment SegmentGrid::nearest_along(const Vec2& place, double radius, const Vec2& direction) const {
  constexpr double least_cosine = -.3;
  return nearest_of(place, radius, [&](const Segment& s) {
    const Vec2 step = s.to - s.from;
    return step.dot(direction) > least_cosine * step.norm();
  });
}

template <typename Accept>
NearestSegment SegmentGrid::nearest_of(const Vec2& place, double radius, Accept&& accepts) const {
  NearestSegment best;
  if (segments_.empty()) return best;
  double least_sq = radius * radius, farthest_line = 0;
  const Cells c = cells_of(place - Vec2::Constant(radius), place + Vec2::Constant(radius));
  for (int y = c.y0; y <= c.y1; ++y)
    for (const Index i : in_row(y, c)) {
      const Segment& s = segments_[i];
      if (!accepts(s)) continue;
      const Vec2 step = s.to - s.from, offset = place - s.from;
      const double length_sq = step.squaredNorm();
      if (!(length_sq > 0)) continue;
      const double share = std::clamp(offset.dot(step) / length_sq, 0.0, 1.0);
      const double distance_sq = (offset - share * step).squaredNorm();
      const bool is_tie = best.segment != no_index && std::abs(distance_sq - least_sq) <= 1e-12 * least_sq;
      if (!is_tie && distance_sq > least_sq) continue;
      const double line = cross(step, offset) / std::sqrt(length_sq);
      if (is_tie && std::abs(line) <= farthest_line) continue;
      least_sq = std::min(least_sq, distance_sq);
      farthest_line = std::abs(line);
      best = {i, std::sqrt(distance_sq), line > 0};
    }
  return best;
}

bool SegmentGrid::is_crossed(const Vec2& a, const Vec2& b) const {
  if (segments_.empty()) return false;
  const Vec2 line = b - a;
  const Cells c = cells_of(a.cwiseMin(b), a.cwiseMax(b));
  for (int y = c.y0; y <= c.y1; ++y)
    for (const Index i : in_row(y, c)) {
      const Segment& s = segments_[i];
      const Vec2 step = s.to - s.from;
      if ((cross(line, s.from - a) > 0) != (cross(line, s.to - a) > 0) &&
          (cross(step, a - s.from) > 0) != (cross(step, b - s.from) > 0))
        return true;
    }
  return false;
}

void LinesFrom::begin(const SegmentGrid& grid, const Vec2& from, double radius) {
  fours_.clear();
  from_ = from;
  if (grid.segments_.empty()) return;
  const Vec2 low = from - Vec2::Constant(radius), high = from + Vec2::Constant(radius);
  const SegmentGrid::Cells c = grid.cells_of(low, high);
  std::size_t lane = 4;
  for (int y = c.y0; y <= c.y1; ++y)
    for (const Index i : grid.in_row(y, c)) {
      const Segment& s = grid.segments_[i];
      if ((s.from.cwiseMin(s.to).array() > high.array()).any()) continue;
      if ((s.from.cwiseMax(s.to).array() < low.array()).any()) continue;
      if (lane == 4) fours_.emplace_back(), lane = 0;
      Four& four = fours_.back();
      const Vec2 u = s.from - from, v = s.to - from, step = s.to - s.from;
      four.from_x[lane] = s.from.x(), four.from_y[lane] = s.from.y();
      four.u_x[lane] = u.x(), four.u_y[lane] = u.y(), four.v_x[lane] = v.x(), four.v_y[lane] = v.y();
      four.step_x[lane] = step.x(), four.step_y[lane] = step.y();
      four.place_is_beside[lane++] = cross(step, from - s.from);
    }
}

bool LinesFrom::is_crossed(const Vec2& to) const {
  return RELIEVO_WIDE(is_any_crossed(to));
}

bool LinesFrom::is_any_crossed(const Vec2& to) const {
  const double x = to.x() - from_.x(), y = to.y() - from_.y();
  auto crossed = Double4{} > 0;
  for (const Four& s : fours_) {
    const auto are_apart = (x * s.u_y - y * s.u_x > 0) ^ (x * s.v_y - y * s.v_x > 0);
    const Double4 end_is_beside = s.step_x * (to.y() - s.from_y) - s.step_y * (to.x() - s.from_x);
    crossed |= are_apart & ((s.place_is_beside > 0) ^ (end_is_beside > 0));
  }
  return (crossed[0] | crossed[1] | crossed[2] | crossed[3]) != 0;
}

}  // namespace relievo
