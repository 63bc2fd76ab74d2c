// Finds the parts of a depth image that are no surface: blur, whose values lie between two surfaces and
// belong to neither surface, and thin teeth on outlines. Tested by tests/scan/depth_image_test.cpp.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scan/depth/depth_grid.h"

namespace relievo {
namespace {

// The square extends this many points to each side of its centre, so it has 3 x 3 points. Teeth are narrower.
constexpr int reach = 1;

// Calls f for those points of the square around a point that are in the grid, until f returns true.
template <typename F>
bool any_around(const BoundedGrid& grid, int column, int row, F&& f) {
  for (int r = std::max(row - reach, 0); r <= std::min(row + reach, grid.height - 1); ++r)
    for (int c = std::max(column - reach, 0); c <= std::min(column + reach, grid.width - 1); ++c)
      if (f(grid.at(c, r))) return true;
  return false;
}

template <typename F>
void each_point(const BoundedGrid& grid, F&& f) {
  for (int r = 0; r < grid.height; ++r)
    for (int c = 0; c < grid.width; ++c) f(c, r);
}

constexpr float least_jump =
    8;  // least height difference of two surfaces with blur between them, in widths of a grid cell

// Returns whether the run of steps from `first` to `last` contains a surface of its own: a step that is small
// compared with the steps before and after it.
bool has_plateau(const GridLine& line, int first, int last) {
  for (int s = first + 1; s < last; ++s) {
    const float around = std::min(std::abs(line.step(s - 1)), std::abs(line.step(s + 1)));
    if (std::abs(line.step(s)) < .25F * around) return true;
  }
  return false;
}

// Finds runs of blurred points in rows and columns.
class BlurFinder {
 public:
  BlurFinder(const DepthGrid& grid, int widest, float least_levels)
      : grid_(grid), widest_(widest), least_levels_(least_levels), is_candidate_(grid.height.size(), 0) {}

  GridMask find() {
    each_line(grid_, [&](const GridLine& line) { mark_runs(line); });
    GridMask is_blurred = is_candidate_;
    if (!grid_.is_sensor) each_line(grid_, [&](const GridLine& line) { keep_surface(line, is_blurred); });
    return is_blurred;
  }

 private:
  bool is_jump(const GridLine& line, int i) const {
    return line.has_step(i) && !grid_.is_near(line.at(i), line.at(i + 1));
  }

  // Returns whether step i jumps away from the surface to which step `next` belongs. For depth cameras the surface's
  // slope is ignored, because noise hides it.
  bool leaves(const GridLine& line, int i, int next) const {
    return is_jump(line, i) && (grid_.is_sensor || !line.continues(i, next));
  }

  void mark_runs(const GridLine& line) {
    for (int i = 0; i < line.size; ++i)
      if (leaves(line, i, i - 1)) mark_run_from(line, i);
  }

  // Marks the points of the shortest blurred run that begins with the jump at step `first`.
  void mark_run_from(const GridLine& line, int first) {
    float whole = line.step(first);
    for (int last = first + 1; last <= first + widest_ && line.step(last) * whole > 0; ++last) {
      whole += line.step(last);
      if (!leaves(line, last, last + 1)) continue;
      if (std::abs(whole) < least_levels_ || has_plateau(line, first, last)) return;
      for (int i = first + 1; i <= last; ++i) is_candidate_[line.at(i)] = 1;
      return;
    }
  }

  // Unmarks the points that continue a surface in the direction of this line. They looked blurred only in the
  // other direction, which happens at the tips of round shapes.
  void keep_surface(const GridLine& line, GridMask& is_blurred) const {
    for (int i = 0; i + 1 < line.size; ++i) {
      const std::size_t here = line.at(i), next = line.at(i + 1);
      if (is_candidate_[here] == is_candidate_[next] || !line.is_smooth(i)) continue;
      is_blurred[here] = is_blurred[next] = 0;
    }
  }

  const DepthGrid& grid_;
  int widest_;
  float least_levels_;
  GridMask is_candidate_;
};

float range_of_heights(const DepthGrid& grid, const GridMask& is_left_out) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (std::size_t i = 0; i < grid.height.size(); ++i)
    if (grid.bounds.is_known[i] && !is_left_out[i])
      low = std::min(low, grid.height[i]), high = std::max(high, grid.height[i]);
  return high > low ? high - low : 0;
}

}  // namespace

std::size_t add_blur(const DepthGrid& grid, const BlurLimits& limits, GridMask& is_left_out) {
  const float least_levels = std::max(least_jump, limits.least_share * range_of_heights(grid, is_left_out));
  const GridMask is_blurred = BlurFinder(grid, limits.widest, least_levels).find();
  std::size_t added = 0;
  for (std::size_t i = 0; i < is_blurred.size(); ++i) {
    if (!is_blurred[i] || is_left_out[i]) continue;
    is_left_out[i] = 1;
    ++added;
  }
  return added;
}

std::size_t drop_teeth(BoundedGrid& grid) {
  GridMask is_inside(grid.is_known.size(), 0);
  each_point(grid, [&](int c, int r) {
    is_inside[grid.at(c, r)] = !any_around(grid, c, r, [&](std::size_t i) { return !grid.is_known[i]; });
  });
  std::size_t dropped = 0;
  each_point(grid, [&](int c, int r) {
    std::uint8_t& is_known = grid.is_known[grid.at(c, r)];
    if (!is_known || any_around(grid, c, r, [&](std::size_t i) { return is_inside[i] != 0; })) return;
    is_known = 0;
    ++dropped;
  });
  return dropped;
}

}  // namespace relievo
