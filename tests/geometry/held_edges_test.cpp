#include "geometry/held_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/plane.h"
#include "support/planar_points.h"

namespace relievo {
namespace {

std::vector<Vec2> points_around_0(std::size_t n, unsigned seed) {
  std::vector<Vec2> points = random_points(n, seed);
  for (Vec2& p : points) p -= Vec2(.5, .5);
  return points;
}

// Returns a closed loop through the points, sorted by their angles. The loop does not cross itself.
std::vector<EdgeEnds> loop_around(const std::vector<Vec2>& points) {
  std::vector<Index> order(points.size());
  for (Index i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](Index i) { return std::atan2(points[i].y(), points[i].x()); });
  std::vector<EdgeEnds> loop;
  for (std::size_t i = 0; i < order.size(); ++i) loop.push_back({order[i], order[(i + 1) % order.size()]});
  return loop;
}

double area_of(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles) {
  double twice = 0;
  for (const auto& [a, b, c] : triangles) {
    const double own = cross(points[b] - points[a], points[c] - points[a]);
    EXPECT_GT(own, 0);
    twice += own;
  }
  return twice / 2;
}

void expect_neighbours(const Triangulation& mesh) {
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index s = mesh.neighbours[t][i];
      if (s == no_index) continue;
      const Index from = mesh.triangles[t][(i + 1) % 3], to = mesh.triangles[t][(i + 2) % 3];
      EXPECT_NE(std::ranges::find(mesh.neighbours[s], t), mesh.neighbours[s].end());
      EXPECT_NE(std::ranges::find(mesh.triangles[s], from), mesh.triangles[s].end());
      EXPECT_NE(std::ranges::find(mesh.triangles[s], to), mesh.triangles[s].end());
    }
}

bool has_edge(const Triangulation& mesh, Index a, Index b) {
  return std::ranges::any_of(mesh.triangles, [&](const Triangle& t) {
    return std::ranges::find(t, a) != t.end() && std::ranges::find(t, b) != t.end();
  });
}

TEST(HeldEdges, AreThereAndTheCoverStays) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<Vec2> points = points_around_0(60, seed);
    const std::vector<EdgeEnds> loop = loop_around(points);
    const HeldTriangulation made = delaunay_with(points, loop);
    const Triangulation plain = delaunay(points);
    ASSERT_EQ(made.mesh.triangles.size(), plain.triangles.size());
    EXPECT_NEAR(area_of(points, made.mesh.triangles), area_of(points, plain.triangles), 1e-12);
    expect_neighbours(made.mesh);
    for (std::size_t e = 0; e < loop.size(); ++e) {
      EXPECT_TRUE(made.is_held[e]);
      EXPECT_TRUE(has_edge(made.mesh, loop[e][0], loop[e][1]));
    }
  }
}

TEST(HeldEdges, ThatCrossOrMeetAPointAreLeftOut) {
  const std::vector<Vec2> points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {1, .2}};
  const std::vector<EdgeEnds> wanted = {{0, 2}, {4, 5}, {3, 5}, {1, 3}, {2, 2}};
  const HeldTriangulation made = delaunay_with(points, wanted);
  EXPECT_EQ(made.is_held, (std::vector<std::uint8_t>{0, 1, 1, 0, 0}));
}

TEST(HeldEdges, NoneGiveDelaunay) {
  const std::vector<Vec2> points = random_points(100, 7);
  EXPECT_EQ(delaunay_with(points, {}).mesh.triangles, delaunay(points).triangles);
}

}  // namespace
}  // namespace relievo
