#include "geometry/point_set.h"

#include <gtest/gtest.h>

#include "support/planar_points.h"

namespace relievo {
namespace {

TEST(PointSet, KeepsItsPointsApart) {
  PointSet set(.05);
  std::vector<Vec2> kept;
  for (const Vec2& p : random_points(2000, 5)) {
    bool is_free = true;
    for (const Vec2& q : kept) is_free &= (p - q).norm() >= .04;
    EXPECT_EQ(set.add(p, .04), is_free);
    if (is_free) kept.push_back(p);
  }
  EXPECT_GT(kept.size(), 100U);
}

TEST(PointSet, KnowsWhatIsNear) {
  PointSet set(1);
  set.add({-.1, 3}, 1);
  EXPECT_TRUE(set.is_near({.1, 3}, .21));
  EXPECT_FALSE(set.is_near({.1, 3}, .19));
  EXPECT_FALSE(set.is_near({50, -3}, 1));
}

}  // namespace
}  // namespace relievo
