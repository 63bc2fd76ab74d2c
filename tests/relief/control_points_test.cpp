#include "relievo/relief/control_points.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>
#include <set>

#include "relievo/scan/boundary.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Points in the plane, and their distances from the nearest boundary point. ring() scatters points over a
// ring, more densely on the left.
struct Figure {
  std::vector<Vec2> points;
  std::vector<float> distance;
};

Figure ring(std::size_t n, std::uint64_t seed = 1) {
  test::Random random(seed);
  Figure figure;
  while (figure.points.size() < n) {
    const Vec2 p(random.uniform(-1, 1), random.uniform(-1, 1));
    if (p.norm() > 1 || p.norm() < .4 || random.uniform(-3, 1) > -p.x()) continue;
    figure.points.push_back(p);
  }
  const double rho = std::sqrt(.84 * std::numbers::pi / static_cast<double>(n));
  figure.distance = find_boundary(figure.points, delaunay(figure.points), rho).distance;
  return figure;
}

double nearest(const Vec2& p, std::span<const Vec2> points, std::span<const Index> among) {
  double least = std::numeric_limits<double>::infinity();
  for (const Index i : among) least = std::min(least, (points[i] - p).norm());
  return least;
}

TEST(ControlPoints, KeepTheirDistanceWhichShrinksTowardsTheBoundary) {
  const Figure figure = ring(10000);
  const ControlPoints control = grow_control_points(figure.points, figure.distance, {500});
  for (std::size_t c = 1; c < control.points.size(); ++c) {
    const Index i = control.points[c];
    const double kept =
        std::min(control.radius, .5 * control.radius + .5 * static_cast<double>(figure.distance[i]));
    ASSERT_GE(nearest(figure.points[i], figure.points, std::span(control.points).first(c)), kept);
  }
}

TEST(ControlPoints, AreDenserAtTheBoundary) {
  const Figure figure = ring(10000);
  for (const double at_boundary : {.25, .5, 1.0}) {
    const ControlPoints control = grow_control_points(figure.points, figure.distance, {500, at_boundary});
    const std::span<const Index> rim = std::span(control.points).first(control.boundary_points);
    for (const Index i : rim) ASSERT_EQ(figure.distance[i], 0);
    for (std::size_t i = 0; i < figure.points.size(); ++i) {
      if (figure.distance[i] == 0)
        ASSERT_LE(nearest(figure.points[i], figure.points, rim), at_boundary * control.radius);
    }
  }
}

TEST(ControlPoints, AreAboutAsManyAsWanted) {
  const Figure figure = ring(20000);
  for (const std::size_t count : {300U, 1000U, 4000U}) {
    const double found =
        static_cast<double>(grow_control_points(figure.points, figure.distance, {count}).points.size());
    EXPECT_NEAR(found / static_cast<double>(count), 1, .1);
  }
}

TEST(ControlPoints, AreAllPointsWhereThatManyAreWanted) {
  const Figure figure = ring(300);
  for (const std::size_t count : {300U, 1000U}) {
    const ControlPoints control = grow_control_points(figure.points, figure.distance, {count});
    EXPECT_EQ(std::set<Index>(control.points.begin(), control.points.end()).size(), 300U);
    EXPECT_EQ(control.radius, 0);
    EXPECT_EQ(control.boundary_points,
              static_cast<std::size_t>(std::count(figure.distance.begin(), figure.distance.end(), 0.F)));
  }
}

TEST(ControlPoints, OfFiguresThinAsALineAreFew) {
  Figure line;
  for (int i = 0; i < 1000; ++i) line.points.emplace_back(i, .001 * (i % 2));
  line.distance.assign(1000, 0);
  const ControlPoints control = grow_control_points(line.points, line.distance, {50});
  EXPECT_GE(control.points.size(), 25U);
  EXPECT_LE(control.points.size(), 100U);
}

TEST(ControlPoints, DoNotDependOnTheOrderOfThePoints) {
  Figure figure = ring(3000);
  const auto places = [](const Figure& f) {
    std::vector<std::pair<double, double>> out;
    for (const Index i : grow_control_points(f.points, f.distance, {200}).points)
      out.emplace_back(f.points[i].x(), f.points[i].y());
    return out;
  };
  const auto before = places(figure);
  std::reverse(figure.points.begin(), figure.points.end());
  std::reverse(figure.distance.begin(), figure.distance.end());
  EXPECT_EQ(before, places(figure));
}

// Points and distances are random. Many points form clusters, and some coincide.
TEST(ControlPoints, CoverAnything) {
  ASSERT_TRUE(rc::check([] {
    const auto cells = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(0, 40), rc::gen::inRange(0, 40)));
    RC_PRE(!cells.empty());
    std::vector<Vec2> points;
    std::vector<float> distance;
    for (const auto& [x, y] : cells) {
      points.emplace_back(x, std::exp2(y / 4.0));
      distance.push_back(static_cast<float>((x * y) % 5));
    }
    const std::size_t count = *rc::gen::inRange<std::size_t>(1, 30);
    const ControlPoints control = grow_control_points(points, distance, {count});
    RC_ASSERT(!control.points.empty());
    for (const Vec2& p : points) RC_ASSERT(nearest(p, points, control.points) <= control.radius);
  }));
}

}  // namespace
}  // namespace relievo
