#include "plate/front/thin_triangles.h"

#include <random>

#include "support/plate_fronts.h"
#include "support/self_intersections.h"

namespace relievo {
namespace {

Solid surface_of(std::vector<Vec3> points, std::vector<Triangle> triangles) {
  Solid solid{std::move(points), std::move(triangles)};
  solid.regions.resize(solid.triangles.size(), Region::ground);
  return solid;
}

TEST(ThinTriangles, AreFlipped) {
  // The third point lies almost on the edge between the first two points. The fourth point is on the
  // other side of this edge.
  Solid solid = surface_of({{0, 0, 1}, {2, 0, 1}, {1, 1e-9, 1.0001}, {1, -1, 1}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_NEAR(flip_thin_triangles(solid), 1e-4, 1e-12);
  EXPECT_EQ(solid.triangles, (std::vector<Triangle>{{0, 3, 2}, {3, 1, 2}}));
}

TEST(ThinTriangles, StayIfTheSurfaceWouldMoveFar) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
  Solid solid = surface_of({{0, 0, 1}, {2, 0, 1}, {1, 1e-6, 3}, {1, -1, 1}}, triangles);
  EXPECT_EQ(flip_thin_triangles(solid), 0);
  EXPECT_EQ(solid.triangles, triangles);
}

TEST(ThinTriangles, AreFlippedEvenThenIfRoundingTurnsThemOver) {
  Solid solid = surface_of({{0, 0, 1}, {2, 3, 1}, {1, 1.5 + 1e-12, 3}, {1, -1, 1}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_NEAR(flip_thin_triangles(solid), 2, 1e-9);
}

TEST(ThinTriangles, OfAChainOfPointsOnOneLineAreAllFlipped) {
  const Index n = 300;
  std::vector<Vec3> points{{0, 0, 0}, {10, 0, 0}, {5, -5, 0}};
  std::vector<Triangle> triangles{{0, 2, 1}};
  for (Index i = 0; i < n; ++i) {
    points.emplace_back(10. * (n - i) / (n + 1), 1e-13 * (i + 1) * (n - i), 0);
    triangles.push_back({0, i == 0 ? 1 : i + 2, i + 3});
  }
  Solid solid = surface_of(points, triangles);
  EXPECT_EQ(flip_thin_triangles(solid), 0);
  for (const auto& [a, b, c] : solid.triangles)
    EXPECT_TRUE(a == 2 || b == 2 || c == 2) << a << " " << b << " " << c;
}

TEST(ThinTriangles, AtAnEdgeOfTheFrontAreRemovedIfItMayLoseEdges) {
  const std::vector<Vec3> points{{0, 0, 1}, {2, 0, 1}, {1, 1e-9, 1.1}, {1, 1, 1}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {2, 1, 3}};
  Solid solid = surface_of(points, triangles);
  flip_thin_triangles(solid);
  EXPECT_EQ(solid.triangles, triangles);
  flip_thin_triangles(solid, true);
  EXPECT_EQ(solid.triangles, (std::vector<Triangle>{{0, 2, 3}, {2, 1, 3}}));
  EXPECT_EQ(solid.regions.size(), 2);
}

// If the thin triangle were removed, the other two triangles would be connected only by point 2.
TEST(ThinTriangles, StayWhereTheFrontWouldHangByACorner) {
  const std::vector<Vec3> points{{0, 0, 1}, {2, 0, 1}, {1, 1e-9, 1}, {0, 1, 1}, {2, 1, 1}};
  Solid solid = surface_of(points, {{0, 1, 2}, {0, 2, 3}, {2, 1, 4}});
  flip_thin_triangles(solid, true);
  EXPECT_EQ(solid.triangles.size(), 3);
}

// The points of a silhouette are almost collinear. Two thin triangles lie outside the line of these points,
// with a slit between them and the wide triangles. The outer thin triangle connects both ends of the slit.
// After its removal, the inner thin triangle connects the ends, so it is removed, too.
TEST(ThinTriangles, BeyondASlitAreAllRemoved) {
  const std::vector<Vec3> points{{0, 0, 1},   {3, 0, 1},  {1, 1e-9, 1}, {2, 1e-9, 1},
                                 {1.5, 0, 1}, {.5, 1, 1}, {1.5, 1, 1},  {2.5, 1, 1}};
  const std::vector<Triangle> wide{{0, 2, 5}, {2, 6, 5}, {2, 4, 6}, {4, 3, 6}, {3, 7, 6}, {3, 1, 7}};
  std::vector<Triangle> triangles = wide;
  triangles.insert(triangles.end(), {{0, 1, 2}, {2, 1, 3}});
  Solid solid = surface_of(points, triangles);
  flip_thin_triangles(solid, true);
  EXPECT_EQ(solid.triangles, wide);
}

// The points of the silhouette are almost collinear. So are the points of the hull, where the ring
// around the relief begins. The plate must not intersect itself, in millimetres or in inches.
TEST(ThinTriangles, LeaveNoPlateThatCutsItself) {
  const auto bumps = [](double x, double y) { return std::sin(3 * x) + std::cos(2 * y); };
  for (const Outline outline : {Outline::none, Outline::rectangle})
    for (const double angle : {0., .1, .3, .7}) {
      PlateOptions options{.outline = outline};
      const Solid solid = test::plate_of(test::turned_grid_front(40, angle, bumps), options);
      EXPECT_EQ(test::self_intersections(solid), "") << angle;
      EXPECT_EQ(test::self_intersections(in_unit(solid, LengthUnit::inch)), "") << angle;
    }
}

// Returns a square front whose points near the centre are very dense: single precision folds their triangles.
Solid dense_surface(double size) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(.499999, .500001);
  std::vector<Vec2> places{{0, 0}, {size, 0}, {size, size}, {0, size}};
  for (int i = 0; i < 100; ++i) places.emplace_back(size * share(random), size * share(random));
  Solid solid;
  for (const Vec2& p : places) solid.points.emplace_back(p.x(), p.y(), 3 + share(random));
  solid.triangles = delaunay(places).triangles;
  solid.front_triangles = solid.triangles.size();
  return solid;
}

TEST(Folds, AreTrianglesThatSinglePrecisionTurnsOver) {
  Solid solid{{{1, 0, 0}, {1 + 1e-9, 1, 5}, {1 - 1e-9, 2, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, 2};
  EXPECT_EQ(find_folds(solid), std::vector<Index>{0});
  solid.points[1].x() = 1.1;
  EXPECT_TRUE(find_folds(solid).empty());
}

TEST(Folds, AreMendedByMovingPointsALittle) {
  const Solid before = dense_surface(100);
  ASSERT_FALSE(find_folds(before).empty());
  Solid after = before;
  unfold(after);
  EXPECT_TRUE(find_folds(after).empty());
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    EXPECT_LT((after.points[i] - before.points[i]).head<2>().cwiseAbs().maxCoeff(), 2e-4);
    EXPECT_EQ(after.points[i].z(), before.points[i].z());
  }
  EXPECT_EQ(test::self_intersections(after), "");
}

TEST(Folds, LeavePointsOfTheOutlineAndTheSidesOfTheBoxWhereTheyAre) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0},           {1, 1, 0},
                                 {0, 1, 0}, {.5, .5 + 1e-12, 1}, {.5, .5, 2}};
  Solid solid{points, {{0, 1, 5}, {1, 2, 5}, {2, 3, 4}, {3, 0, 4}, {0, 5, 4}, {5, 2, 4}}, 6};
  unfold(solid, std::array<Index, 1>{5});
  EXPECT_TRUE(find_folds(solid).empty());
  for (const Index i : {0, 1, 2, 3, 5}) EXPECT_EQ(solid.points[i], points[i]) << i;
  EXPECT_NE(solid.points[4], points[4]);
}

TEST(Folds, TakeThePointsBelowAlong) {
  Solid solid{{{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {2, 2 - 1e-9, 1}, {2, 2 - 1e-9, 0}, {0, 4, 1}},
              {{0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 5}, {0, 4, 1}},
              4};
  unfold(solid);
  EXPECT_TRUE(find_folds(solid).empty());
  EXPECT_EQ(solid.points[4].head<2>(), solid.points[3].head<2>());
  EXPECT_EQ(solid.points[4].z(), 0);
}

}  // namespace
}  // namespace relievo
