#include "plate/front/thin_triangles.h"

#include <gtest/gtest.h>

#include <random>

#include "relievo/geometry/triangulation.h"
#include "support/self_intersections.h"

namespace relievo {
namespace {

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
