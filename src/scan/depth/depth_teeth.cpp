// Removes thin teeth from the outlines of depth images.
#include <algorithm>

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

}  // namespace

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
