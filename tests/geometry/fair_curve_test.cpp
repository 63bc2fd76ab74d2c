#include "geometry/fair_curve.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace relievo {
namespace {

std::vector<CurveNode> circle_nodes(int count, double radius, double noise) {
  test::Random random(7);
  std::vector<CurveNode> nodes;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(-.4, .4)) / count;
    nodes.push_back({(radius + noise * random.gaussian()) * Vec2(std::cos(angle), std::sin(angle))});
  }
  return nodes;
}

// Returns nodes along the sides of a square of side 2 * half, with noise across the sides. The nodes start
// at the lower left corner and run counter-clockwise.
std::vector<CurveNode> square_nodes(int per_side, double half, double noise) {
  test::Random random(9);
  const std::array<Vec2, 4> corners{Vec2(-half, -half), Vec2(half, -half), Vec2(half, half),
                                    Vec2(-half, half)};
  std::vector<CurveNode> nodes;
  for (std::size_t side = 0; side < 4; ++side)
    for (int i = 0; i < per_side; ++i) {
      const Vec2 step = corners[(side + 1) % 4] - corners[side];
      const Vec2 across = Vec2(-step.y(), step.x()).normalized();
      nodes.push_back({corners[side] + (i + .5) / per_side * step + noise * random.gaussian() * across});
    }
  return nodes;
}

TEST(FairCurve, ThroughExactNodesOfACircleLiesOnIt) {
  const FairCurve curve = fair_curve(circle_nodes(200, 30, 0), true, {1, 4});
  ASSERT_NEAR(static_cast<double>(curve.points.size()), 2 * std::numbers::pi * 30, 3);
  for (const Vec2& p : curve.points) EXPECT_NEAR(p.norm(), 30, 3e-3);
  for (const std::uint8_t corner : curve.is_corner) EXPECT_FALSE(corner);
}

TEST(FairCurve, IsEvenlySpaced) {
  const std::vector<Vec2> points = fair_curve(circle_nodes(200, 30, .2), true, {1, 4}).points;
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR((points[(i + 1) % points.size()] - points[i]).norm(), 1, .1);
}

TEST(FairCurve, RemovesMostOfTheNoise) {
  double squares = 0;
  const FairCurve curve = fair_curve(circle_nodes(200, 30, .3), true, {1, 4});
  for (const Vec2& p : curve.points) squares += (p.norm() - 30) * (p.norm() - 30);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(curve.points.size())), .2);
}

TEST(FairCurve, KeepsTheCornersOfASquare) {
  const FairCurve curve = fair_curve(square_nodes(40, 20, .1), true, {1, 4});
  int corners = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    EXPECT_NEAR(curve.points[i].cwiseAbs().maxCoeff(), 20, .3);
    if (!curve.is_corner[i]) continue;
    ++corners;
    EXPECT_NEAR(curve.points[i].cwiseAbs().minCoeff(), 20, .3);
  }
  EXPECT_EQ(corners, 4);
}

// Returns nodes along a wedge that opens towards -x. Its tip is an arc of the given radius around the
// origin, and its sides are 20 long. The nodes start at the end of the lower side.
std::vector<CurveNode> wedge_nodes(double degrees, double radius) {
  constexpr double side = 20, pi = std::numbers::pi;
  const double turn = pi - degrees * pi / 180, arc = turn * radius;
  std::vector<CurveNode> nodes;
  for (double at = -side; at < arc + side; at += 1) {
    const double direction = std::clamp(at / std::max(arc, 1e-9), 0., 1.) * turn - turn / 2;
    const Vec2 out(std::cos(direction), std::sin(direction)), along(-out.y(), out.x());
    nodes.push_back({radius * out + (at < 0 ? at : std::max(0., at - arc)) * along});
  }
  return nodes;
}

// If the curve followed the lines of the wedge's sides, it would have a barb where they meet: at x
// = radius / sin(angle / 2), far outside the arc.
TEST(FairCurve, OfARoundTipHasNoBarb) {
  constexpr double radius = 3;
  for (const double degrees : {50., 70., 90.}) {
    const FairCurve curve = fair_curve(wedge_nodes(degrees, radius), false, {.75, 3});
    for (const Vec2& p : curve.points) EXPECT_LT(p.x(), radius + .01) << degrees;
    EXPECT_EQ(std::ranges::count(curve.is_corner, 1), 0) << degrees;
  }
}

TEST(FairCurve, RoundsTheTipOfASharpWedge) {
  constexpr double least_radius = .5;
  for (const double degrees : {40., 50., 60.}) {
    const FairCurve curve = fair_curve(wedge_nodes(degrees, 0), false, {.75, 3});
    EXPECT_EQ(std::ranges::count(curve.is_corner, 1), 0) << degrees;
    for (std::size_t k = 2; k < curve.points.size(); ++k) {
      const Vec2 u = curve.points[k - 1] - curve.points[k - 2], v = curve.points[k] - curve.points[k - 1];
      const double four_areas = 2 * std::abs(u.x() * v.y() - u.y() * v.x());
      EXPECT_GT(u.norm() * v.norm() * (u + v).norm(), least_radius * four_areas) << degrees;
    }
  }
}

TEST(FairCurve, OfAnOpenLineReachesBothEnds) {
  std::vector<CurveNode> nodes;
  for (int i = 0; i <= 30; ++i) nodes.push_back({Vec2(i, .5 * i)});
  const FairCurve curve = fair_curve(nodes, false, {1, 4});
  ASSERT_FALSE(curve.points.empty());
  EXPECT_LT((curve.points.front() - Vec2(0, 0)).norm(), 1e-2);
  EXPECT_LT((curve.points.back() - Vec2(30, 15)).norm(), 1e-2);
  for (const Vec2& p : curve.points) EXPECT_NEAR(p.y(), .5 * p.x(), 1e-6);
}

TEST(FairCurve, TrustsANodeByItsWeight) {
  std::vector<CurveNode> nodes = circle_nodes(200, 30, 0);
  for (std::size_t i = 0; i < nodes.size(); i += 2) nodes[i].place *= 1.02, nodes[i].weight = 1e-6;
  for (const Vec2& p : fair_curve(nodes, true, {1, 4}).points) EXPECT_NEAR(p.norm(), 30, .01);
}

TEST(FairCurve, IsEmptyIfTooShort) {
  EXPECT_TRUE(fair_curve(circle_nodes(20, .3, 0), true, {1, 4}).points.empty());
  EXPECT_TRUE(fair_curve(circle_nodes(5, 30, 0), true, {1, 4}).points.empty());
  EXPECT_TRUE(fair_curve({}, false, {1, 4}).points.empty());
}

TEST(FairCurve, StaysNearItsNodesWhateverTheyAre) {
  // The nodes are so few and turn so sharply that there may be no node between two corners.
  test::Random random(5);
  const Vec2 start(100, 200);
  for (int trial = 0; trial < 2000; ++trial) {
    const bool is_closed = trial % 2 == 0;
    const int count = 6 + trial % 20;
    std::vector<CurveNode> nodes{{start}};
    double direction = 0;
    for (int k = 1; k < count; ++k) {
      if (random.uniform() < .3) direction += random.uniform(-2.5, 2.5);
      nodes.push_back(
          {nodes.back().place + random.uniform(.1, 1.5) * Vec2(std::cos(direction), std::sin(direction))});
    }
    const FairCurve curve = fair_curve(nodes, is_closed, {.75, 3});
    for (const Vec2& p : curve.points) EXPECT_LT((p - start).norm(), 60);
  }
}

}  // namespace
}  // namespace relievo
