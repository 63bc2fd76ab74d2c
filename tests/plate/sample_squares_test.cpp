#include <algorithm>
#include <cmath>
#include <limits>

#include "support/triangles.h"

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

// Returns the slopes of a cylinder along y. The normal turns by the angle `turn` from one cell to the next.
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
  EXPECT_EQ(large, 16);  // at the edge of the grid the squares are smaller
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
  // Around a cone, the slope changes its direction but not its size. This turns the normals of a steep cone
  // more than those of a flat one. So the steep cone needs smaller squares.
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

// A square grid of points on a roof. The roof's ridge runs along a diagonal of the square: from the
// lower left corner or, if `direction` is -1, from the upper left corner.
struct Roof {
  std::vector<Vec2> points;
  std::vector<Vec2f> slopes;
  std::vector<double> heights;
  Triangulation mesh;

  explicit Roof(double direction) {
    constexpr int side = 12;
    for (int i = 0; i < side * side; ++i) {
      const Vec2 p(.1 * (i % side), .1 * (i / side));
      const double across = p.x() - (direction > 0 ? p.y() : .1 * (side - 1) - p.y());
      const auto sign = static_cast<float>((across > 1e-9) - (across < -1e-9));
      points.push_back(p);
      slopes.push_back(-sign * Vec2f(1, static_cast<float>(-direction)));
      heights.push_back(-std::abs(across));
    }
    mesh = delaunay(points);
  }

  // Returns the largest vertical distance between the roof and the midpoints of the mesh's edges.
  double error(double direction) const {
    double most = 0;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3];
        const Vec2 middle = (points[a] + points[b]) / 2;
        const double across = middle.x() - (direction > 0 ? middle.y() : 1.1 - middle.y());
        most = std::max(most, std::abs((heights[a] + heights[b]) / 2 + std::abs(across)));
      }
    return most;
  }
};

TEST(Diagonals, FollowARidge) {
  // Edges of the Delaunay triangulation cross the ridge, at least for one of the two directions.
  EXPECT_GT(std::max(Roof(1).error(1), Roof(-1).error(-1)), .05);
  for (const double direction : {1., -1.}) {
    Roof roof(direction);
    turn_diagonals(roof.points, roof.slopes, roof.mesh);
    EXPECT_LT(roof.error(direction), 1e-9);
    test::expect_counter_clockwise(roof.points, roof.mesh.triangles);
    EXPECT_NEAR(test::area_of(roof.points, roof.mesh.triangles), 1.1 * 1.1, 1e-12);
  }
}

TEST(Diagonals, StayWhereSlopesAreUnknown) {
  for (const double direction : {1., -1.}) {
    Roof roof(direction);
    roof.slopes.assign(roof.slopes.size(), Vec2f::Constant(std::numeric_limits<float>::quiet_NaN()));
    const std::vector<Triangle> before = roof.mesh.triangles;
    turn_diagonals(roof.points, roof.slopes, roof.mesh);
    EXPECT_EQ(roof.mesh.triangles, before);
  }
}

}  // namespace
}  // namespace relievo
