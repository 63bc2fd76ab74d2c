#include "relievo/scan/spacing.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace relievo {
namespace {

TEST(Spacing, OfRandomPointsIsTheSquareRootOfTheAreaPerPoint) {
  const std::size_t n = 40000;
  const double truth = std::sqrt(4 * std::numbers::pi / n);
  EXPECT_NEAR(measure_spacing(test::sphere(n, 1)).rho / truth, 1, .03);
}

TEST(Spacing, ScalesWithTheCloudAndDoesNotDependOnTheOrder) {
  const Cloud cloud = test::sphere(2000, 1);
  const double rho = measure_spacing(cloud).rho;
  EXPECT_DOUBLE_EQ(measure_spacing(test::scaled(cloud, 8)).rho, 8 * rho);
  EXPECT_EQ(measure_spacing(test::reversed(cloud)).rho, rho);
}

// If the search read all coincident points, it would take minutes.
TEST(Spacing, IsFoundAmongManyCoincidentPoints) {
  Cloud cloud = test::sphere(150'000, 1);
  const double rho = measure_spacing(cloud).rho;
  cloud.points.resize(250'000, Vec3(0, 0, 5));
  const Spacing spacing = measure_spacing(cloud);
  EXPECT_EQ(spacing.local.back(), 0);
  EXPECT_GT(spacing.rho, .5 * rho);
}

// Compares the neighbours with neighbours found by brute force.
TEST(Spacing, FindsTheNearestOtherPoints) {
  const Cloud cloud = test::sphere(300, 1);
  const Spacing spacing = measure_spacing(cloud);
  for (Index i = 0; i < cloud.size(); ++i) {
    std::vector<double> distances;
    for (Index j = 0; j < cloud.size(); ++j)
      if (j != i) distances.push_back((cloud.points[i] - cloud.points[j]).norm());
    std::sort(distances.begin(), distances.end());
    for (std::size_t k = 0; k < spacing_neighbours; ++k) {
      ASSERT_NE(spacing.nearest[i][k], i);
      EXPECT_DOUBLE_EQ((cloud.points[i] - cloud.points[spacing.nearest[i][k]]).norm(), distances[k]);
    }
    EXPECT_FLOAT_EQ(spacing.local[i], static_cast<float>(std::sqrt(std::numbers::pi / 8) * distances[7]));
  }
}

TEST(Spacing, OfTwinsDoesNotCountThePointItself) {
  Cloud cloud = test::sphere(100, 1);
  const std::vector<Vec3> once = cloud.points;
  cloud.points.insert(cloud.points.end(), once.begin(), once.end());
  const Spacing spacing = measure_spacing(cloud);
  for (Index i = 0; i < cloud.size(); ++i)
    EXPECT_EQ(std::count(spacing.nearest[i].begin(), spacing.nearest[i].end(), i), 0);
}

TEST(Spacing, OfDegenerateCloudsIsZero) {
  EXPECT_EQ(measure_spacing({}).rho, 0);
  EXPECT_EQ(measure_spacing({{Vec3::Zero()}, {}}).rho, 0);
  EXPECT_EQ(measure_spacing({std::vector<Vec3>(20, Vec3(1, 2, 3)), {}}).rho, 0);
}

TEST(Spacing, OfFewPointsLeavesTheOtherNeighboursOpen) {
  const Spacing spacing = measure_spacing({{Vec3::Zero(), Vec3::UnitX()}, {}});
  EXPECT_EQ(spacing.nearest[0][0], 1U);
  EXPECT_EQ(spacing.nearest[0][1], no_index);
  EXPECT_DOUBLE_EQ(spacing.rho, static_cast<double>(static_cast<float>(std::sqrt(std::numbers::pi))));
}

}  // namespace
}  // namespace relievo
