// Tests that only thin teeth of outlines are removed: parts that are less than three pixels wide.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>

#include "scan/depth/depth_grid.h"

namespace relievo {
namespace {

// Returns a grid in which '#' marks the known points.
BoundedGrid grid_of(const std::vector<std::string>& rows) {
  BoundedGrid grid{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}, {}, {}, {}, {}};
  for (const std::string& row : rows)
    for (const char c : row) grid.is_known.push_back(c == '#');
  return grid;
}

TEST(DropTeeth, TakesOffWhatIsThinnerThanThreePoints) {
  BoundedGrid grid = grid_of({"...........#",  //
                              ".....#......",  //
                              ".....#..####",  //
                              ".########.##",  //
                              ".#####......",  //
                              ".#####...##.",  //
                              "...#.....##.",  //
                              "..#........."});
  const BoundedGrid wanted = grid_of({"............",  //
                                      "............",  //
                                      "............",  //
                                      ".#####......",  //
                                      ".#####......",  //
                                      ".#####......",  //
                                      "............",  //
                                      "............"});
  const auto before = std::ranges::count(grid.is_known, 1), after = std::ranges::count(wanted.is_known, 1);
  EXPECT_EQ(drop_teeth(grid), static_cast<std::size_t>(before - after));
  EXPECT_EQ(grid.is_known, wanted.is_known);
}

TEST(DropTeeth, TheEdgeOfTheImageIsNoOutline) {
  BoundedGrid grid = grid_of({"##..", "##..", "....", "####"});
  EXPECT_EQ(drop_teeth(grid), 4U) << "the row at the bottom is a single one";
  EXPECT_EQ(grid.is_known, grid_of({"##..", "##..", "....", "...."}).is_known);
}

// Returns whether the point belongs to a square of 3 x 3 known points. Points outside the grid count as
// known.
bool is_in_square(const BoundedGrid& grid, int column, int row) {
  const auto is_unknown = [&](int c, int r) {
    const bool is_there = c >= 0 && r >= 0 && c < grid.width && r < grid.height;
    return is_there && !grid.is_known[grid.at(c, r)];
  };
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, grid.height - 1); ++y)
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, grid.width - 1); ++x) {
      bool is_whole = true;
      for (int i = 0; i < 9; ++i) is_whole = is_whole && !is_unknown(x - 1 + i % 3, y - 1 + i / 3);
      if (is_whole) return true;
    }
  return false;
}

TEST(DropTeeth, KeepsWhatSquaresContainAndIsDoneAtOnce) {
  ASSERT_TRUE(rc::check([] {
    const int width = *rc::gen::inRange(1, 12), height = *rc::gen::inRange(1, 12);
    BoundedGrid grid{width, height, {}, {}, {}, {}, {}};
    for (int i = 0; i < width * height; ++i) grid.is_known.push_back(*rc::gen::inRange(0, 8) > 0);
    const BoundedGrid given = grid;
    drop_teeth(grid);
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c)
        RC_ASSERT((grid.is_known[grid.at(c, r)] != 0) ==
                  (given.is_known[grid.at(c, r)] != 0 && is_in_square(given, c, r)));
    RC_ASSERT(drop_teeth(grid) == 0U);
  }));
}

}  // namespace
}  // namespace relievo
