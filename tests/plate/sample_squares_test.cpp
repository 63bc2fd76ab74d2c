
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plate/front/sample_front.h"

namespace relievo {
namespace {

constexpr float angle = .03F, none = std::numeric_limits<float>::quiet_NaN();

// Returns a grid of 64 x 64 cells with the given slopes.
template <typename Slope>
Image<Vec2f> grid_of(Slope slope) {
  Image<Vec2f> slopes = filled_image(64, 64, Vec2f(Vec2f::Zero()));
  for (int y = 0; y < slopes.height; ++y)
    for (int x = 0; x < slopes.width; ++x) slopes.at(x, y) = slope(x, y);
  return slopes;
}

// Returns the slopes of a cylinder along y. Its normal turns by the angle `turn` from cell to cell.
Image<Vec2f> cylinder(float turn) {
  return grid_of([&](int x, int) { return Vec2f(std::tan(turn * static_cast<float>(x - 32)), 0); });
}

// Returns the number of squares that cover each cell.
Image<int> cover(const std::vector<SampleSquare>& squares) {
  Image<int> covered = filled_image(64, 64, 0);
  for (const SampleSquare& s : squares)
    for (int y = s.y; y < s.y + s.side; ++y)
      for (int x = s.x; x < s.x + s.side; ++x) ++covered.at(x, y);
  return covered;
}

std::size_t quartered(const std::vector<SampleSquare>& squares) {
  return static_cast<std::size_t>(std::ranges::count_if(squares, &SampleSquare::is_quartered));
}

TEST(SampleSquares, CoverEachCellWithASlopeOnce) {
  const Image<Vec2f> disc = grid_of([](int x, int y) {
    const float r = std::hypot(static_cast<float>(x - 32), static_cast<float>(y - 32));
    return r < 30 ? Vec2f(.0005F * r * r, 0) : Vec2f(none, none);
  });
  const Image<int> covered = cover(sample_squares(disc, angle));
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) EXPECT_EQ(covered.at(x, y), disc.at(x, y).allFinite() ? 1 : 0);
}

TEST(SampleSquares, AreLargeOnAPlane) {
  const std::vector<SampleSquare> squares = sample_squares(cylinder(0), angle);
  const auto large = std::ranges::count(squares, largest_square, &SampleSquare::side);
  EXPECT_EQ(large, 16);  // smaller squares surround these at the edge of the grid
  EXPECT_EQ(quartered(squares), 0);
}

TEST(SampleSquares, TurnByNoMoreThanTheAngle) {
  for (const float turn : {.005F, .01F, .02F}) {
    const std::vector<SampleSquare> squares = sample_squares(cylinder(turn), angle);
    int widest = 1;
    for (const SampleSquare& s : squares) widest = std::max(widest, s.side);
    EXPECT_LE(static_cast<float>(widest) * turn, angle) << turn;
    EXPECT_GT(static_cast<float>(2 * widest) * turn, angle) << turn;
    EXPECT_EQ(quartered(squares), 0) << turn;
  }
}

TEST(SampleSquares, AreQuarteredWhereTheSurfaceTurnsEvenlyByMore) {
  EXPECT_GT(quartered(sample_squares(cylinder(.035F), angle)), 64 * 50);
  const Image<Vec2f> grain = grid_of([](int x, int) {
    return Vec2f(std::tan(.05F * static_cast<float>(x - 32)) + .02F * static_cast<float>(x % 2), 0);
  });
  EXPECT_LT(quartered(sample_squares(grain, angle)), 64 * 10);
  EXPECT_EQ(quartered(sample_squares(cylinder(.04F), .01F)), 0);  // such large angles count as creases
}

TEST(SampleSquares, TurnAsMuchWhereTheSlopeTurnsAside) {
  // Around a cone, the slope keeps its steepness but changes its direction. This turns the normals of a steep
  // cone more than those of a flat one, so the steep cone needs smaller squares.
  const auto cone = [](float steepness) {
    return grid_of([&](int x, int y) {
      return Vec2f(steepness *
                   Vec2f(static_cast<float>(x) + 100.5F, static_cast<float>(y) - 31.5F).normalized());
    });
  };
  const auto largest = [](const std::vector<SampleSquare>& squares) {
    return std::ranges::max(squares, {}, &SampleSquare::side).side;
  };
  EXPECT_GT(largest(sample_squares(cone(.5F), angle)), largest(sample_squares(cone(4), angle)));
}

TEST(SampleSquares, DifferByAFactorOfTwoAtMostFromTheirNeighbours) {
  const std::vector<SampleSquare> squares = sample_squares(
      grid_of([](int x, int) { return Vec2f(1e-5F * static_cast<float>(x * x * x), 0); }), angle);
  Image<int> side = filled_image(64, 64, 0);
  for (const SampleSquare& s : squares)
    for (int k = 0; k < s.side * s.side; ++k) side.at(s.x + k % s.side, s.y + k / s.side) = s.side;
  int steps = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x + 1 < 64; ++x) {
      const auto [small, large] = std::minmax(side.at(x, y), side.at(x + 1, y));
      EXPECT_LE(large, 2 * small);
      steps += large > small;
    }
  EXPECT_GT(steps, 0);
}

}  // namespace
}  // namespace relievo
