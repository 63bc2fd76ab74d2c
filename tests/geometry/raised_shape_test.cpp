#include "geometry/raised_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relievo {
namespace {

// Returns the outlines of an L with arms of width 2 and 0.5. The wide arm has a hole.
Outlines ell() {
  return {{{0, 0}, {6, 0}, {6, .5}, {2, .5}, {2, 5}, {0, 5}}, {{.8, 3}, {.8, 3.6}, {1.4, 3.6}, {1.4, 3}}};
}

double distance_to(const std::vector<Segment>& sides, const Vec2& p) {
  double least = 1e9;
  for (const Segment& s : sides) {
    const Vec2 step = s.to - s.from;
    const double share = std::clamp((p - s.from).dot(step) / step.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (s.from + share * step - p).norm());
  }
  return least;
}

TEST(RaisedShape, HasExactHeights) {
  const RaisedShape shape{"it", ell(), leaning_wall(.7, 2), .2};
  const ShapePoints made = points_of(shape);
  const std::vector<Segment> sides = union_boundary(shape.outlines);
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    const Vec3& p = made.points[i];
    const double distance = distance_to(sides, p.head<2>());
    EXPECT_NEAR(p.z(), std::min(.7, 2 * distance), 1e-5) << p.transpose();
    EXPECT_EQ(p.z() == 0, i < made.feet);
    if (i < made.feet) continue;
    EXPECT_NE(winding_number(shape.outlines, p.head<2>()), 0);
  }
  EXPECT_EQ(made.most_mm, .7);
  EXPECT_NEAR(made.thinnest_mm, .5, 5e-6);
}

TEST(RaisedShape, OfAThinBarReachesWhereItsWallsMeet) {
  const Outlines bar = {{{0, 0}, {8, 0}, {8, .4}, {0, .4}}};
  EXPECT_NEAR(points_of({"it", bar, leaning_wall(.7, 2), .2}).most_mm, .4, 1e-5);
  EXPECT_NEAR(points_of({"it", bar, leaning_wall(-.7, 2), .2}).most_mm, .4, 1e-5);
}

TEST(RaisedShape, ScalesWithItsOutlines) {
  const ShapePoints small = points_of({"it", ell(), leaning_wall(.5, 2), .2});
  Outlines twice = ell();
  for (std::vector<Vec2>& outline : twice)
    for (Vec2& p : outline) p *= 2;
  const ShapePoints large = points_of({"it", twice, leaning_wall(1, 2), .4});
  ASSERT_EQ(small.points.size(), large.points.size());
  for (std::size_t i = 0; i < small.points.size(); ++i)
    EXPECT_LT((2 * small.points[i] - large.points[i]).norm(), 1e-5);
}

TEST(RaisedShape, RoundWallsAreNowhereTooSteep) {
  for (const double slope : {.5, 1., 3.7, 50.})
    for (const double height : {-3., .2, 5.}) {
      const std::vector<WallLevel> levels = round_wall(height, 2, slope);
      for (std::size_t k = 1; k < levels.size(); ++k) {
        const double rise = levels[k].height_mm - levels[k - 1].height_mm;
        EXPECT_GT(rise * height, 0);
        EXPECT_LE(std::abs(rise), slope * (levels[k].distance_mm - levels[k - 1].distance_mm) + 1e-12);
      }
      EXPECT_LE(std::abs(levels.back().height_mm), std::abs(height) + 1e-12);
      EXPECT_EQ(levels.back().distance_mm, 2);
    }
}

TEST(RaisedShape, OfADiscWithARoundWallIsABall) {
  std::vector<Vec2> disc;
  for (int k = 0; k < 200; ++k) {
    const double angle = 2 * std::numbers::pi * k / 200;
    disc.emplace_back(2 * std::cos(angle), 2 * std::sin(angle));
  }
  const double apothem = 2 * std::cos(std::numbers::pi / 200);
  const ShapePoints made = points_of({"it", {disc}, round_wall(1, apothem, 2), .3});
  const double ball = (apothem * apothem + 1) / 2;
  EXPECT_EQ(made.most_mm, 1);
  for (const Vec3& p : made.points) {
    const double wanted = std::sqrt(ball * ball - p.head<2>().squaredNorm()) - (ball - 1);
    EXPECT_NEAR(p.z(), std::max(0.0, wanted), .002);
  }
}

}  // namespace
}  // namespace relievo
