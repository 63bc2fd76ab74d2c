#include "relievo/scan/cloud.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace relievo {
namespace {

TEST(Bounds, HoldAllPoints) {
  EXPECT_TRUE(bounds({}).is_empty());
  EXPECT_EQ(bounds({}).diagonal(), 0);
  const Box box = bounds({{Vec3(1, 5, -2), Vec3(3, -1, 0)}, {}});
  EXPECT_EQ(box.min, Vec3(1, -1, -2));
  EXPECT_EQ(box.max, Vec3(3, 5, 0));
}

TEST(Outliers, AreThoseAtAnotherPlaceAltogether) {
  Cloud cloud = test::sphere(1000, 1);
  for (Vec3& p : cloud.points) p += Vec3(4e5, 5e6, 100);
  EXPECT_TRUE(outliers(cloud).empty());
  test::add(cloud, Vec3::Zero(), Vec3::UnitZ());
  test::add(cloud, Vec3(4e5, 5e6, 110), Vec3::UnitZ());  // far away, but it may belong to another object
  EXPECT_EQ(outliers(cloud), std::vector<Index>{1000});
}

TEST(Outliers, OfEqualPointsAreNone) {
  EXPECT_TRUE(outliers({}).empty());
  EXPECT_TRUE(outliers({std::vector<Vec3>(10, Vec3::Ones()), {}}).empty());
}

TEST(ErasePoints, LeavesOutPointsWithTheirNormals) {
  const Cloud cloud{{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()},
                    {Vec3f::UnitX(), Vec3f::UnitY(), Vec3f::UnitZ()}};
  const std::vector<Index> left_out{0, 2};
  const Cloud kept = erase_points(cloud, left_out);
  EXPECT_EQ(kept.points, std::vector<Vec3>{Vec3::UnitX()});
  EXPECT_EQ(kept.normals, std::vector<Vec3f>{Vec3f::UnitY()});
}

}  // namespace
}  // namespace relievo
