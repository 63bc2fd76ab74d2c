#include "geometry/plane.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(Plane, CrossProductIsPositiveToTheLeft) {
  EXPECT_EQ(cross({2, 0}, {1, 3}), 6);
  EXPECT_EQ(cross({1, 3}, {2, 0}), -6);
  EXPECT_EQ(cross({1, 3}, {2, 6}), 0);
}

// The hypotenuse of a right-angled triangle is the diameter of the triangle's circumcircle.
TEST(Plane, CircumradiusOfARightAngleIsHalfTheHypotenuse) {
  EXPECT_DOUBLE_EQ(circumradius({0, 0}, {3, 0}, {0, 4}), 2.5);
  EXPECT_DOUBLE_EQ(circumradius({0, 4}, {3, 0}, {0, 0}), 2.5);
  EXPECT_EQ(circumradius({0, 0}, {1, 1}, {2, 2}), std::numeric_limits<double>::infinity());
}

TEST(Plane, HatFunctionsAreOneAtTheirCornerAndZeroAtTheOthers) {
  const std::array<Vec2, 3> corners{Vec2(1, 2), Vec2(4, 3), Vec2(2, 7)};
  const auto gradients = hat_gradients(corners, cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (std::size_t i = 0; i < 3; ++i)
    for (const std::size_t other : {(i + 1) % 3, (i + 2) % 3})
      EXPECT_NEAR(gradients[i].dot(corners[i] - corners[other]), 1, 1e-15);
}

}  // namespace
}  // namespace relievo
