#include "scan/merging/repeated_points.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace relievo {
namespace {

Cloud subsample(const Cloud& cloud, double wanted) {
  return relievo::subsample(cloud, measure_spacing(cloud), wanted);
}

TEST(Subsample, HasAboutTheSpacingAskedFor) {
  const Cloud cloud = test::sphere(60000, 1);
  const double own = measure_spacing(cloud).rho;
  for (const double times : {1.2, 1.4, 2.0, 4.0})
    EXPECT_NEAR(measure_spacing(subsample(cloud, times * own)).rho, times * own, .08 * times * own) << times;
}

TEST(Subsample, KeepsPointsOfTheCloudAndNoTwoClose) {
  const Cloud cloud = test::torus(20000, 1, .4);
  const Cloud thin = subsample(cloud, .1);
  for (std::size_t i = 0; i < thin.size(); ++i) {
    EXPECT_NE(std::ranges::find(cloud.points, thin.points[i]), cloud.points.end());
    for (std::size_t j = 0; j < i; ++j) ASSERT_GT((thin.points[i] - thin.points[j]).norm(), .05);
  }
}

TEST(Subsample, AveragesNormalsAndColours) {
  Cloud cloud = test::noisy(test::sheet(100000, 1, 0), 0, .2);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.colours.push_back({static_cast<std::uint8_t>(i % 2 ? 200 : 100), 7, 7});
  const Cloud thin = subsample(cloud, .1);
  ASSERT_GT(thin.size(), 100U);
  for (std::size_t i = 0; i < thin.size(); ++i) {
    EXPECT_GT(thin.normals[i].z(), .99F);
    EXPECT_NEAR(thin.colours[i][0], 150, 25);
    EXPECT_EQ(thin.colours[i][1], 7);
  }
}

TEST(Subsample, BothSidesOfAThinWallStay) {
  const Cloud wall = test::sheet(20000, 1, 0);
  const Cloud back = test::inside_out(test::sheet(20000, 1, -1e-3, 9));
  const Cloud thin = subsample(test::joined(wall, back), .1);
  const auto facing = std::ranges::count_if(thin.normals, [](const Vec3f& n) { return n.z() > .9F; });
  const auto away = std::ranges::count_if(thin.normals, [](const Vec3f& n) { return n.z() < -.9F; });
  EXPECT_EQ(static_cast<std::size_t>(facing + away), thin.size());
  EXPECT_NEAR(static_cast<double>(facing), static_cast<double>(away), .1 * static_cast<double>(facing));
}

TEST(Subsample, OfNothingIsNothing) {
  EXPECT_EQ(subsample({}, 1).size(), 0U);
}

}  // namespace
}  // namespace relievo
