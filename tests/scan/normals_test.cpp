#include "relievo/scan/normals.h"

#include <gtest/gtest.h>

#include "relievo/scan/view.h"
#include "relievo/scan/visible.h"
#include "support/shapes.h"

namespace relievo {
namespace {

TEST(EstimateNormals, OfASphereAreRadial) {
  const Cloud truth = test::sphere(20000, 5);
  Cloud cloud{truth.points, {}};
  estimate_normals(cloud);
  ASSERT_EQ(cloud.normals.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    ASSERT_GT(std::abs(cloud.normals[i].dot(truth.normals[i])), .99F);
}

TEST(EstimateNormals, OfTwinsOnAPointAreUnitVectors) {
  Cloud cloud{std::vector<Vec3>(50, Vec3(1, 2, 3)), {}};
  estimate_normals(cloud);
  for (const Vec3f& n : cloud.normals) EXPECT_NEAR(n.norm(), 1, 1e-5);
}

TEST(EstimateNormals, LeavesTwoPointsAlone) {
  Cloud two{{Vec3::Zero(), Vec3::UnitX()}, {}};
  estimate_normals(two);
  EXPECT_FALSE(two.has_normals());
}

TEST(TurnToViewer, LeavesNoNormalFacingAway) {
  Cloud sphere = test::sphere(1000, 1);
  turn_to_viewer(sphere);
  for (const Vec3f& n : sphere.normals) EXPECT_GE(n.z(), 0);
}

// The estimated normals of a sphere must have the same signs as the true ones, even on its back.
TEST(TurnToViewer, GoesOnRoundAnEdge) {
  const Cloud truth = test::sphere(20000, 1);
  Cloud cloud{truth.points, {}};
  estimate_normals(cloud);
  turn_to_viewer(cloud);
  const Spacing spacing = measure_spacing(cloud);
  spread_normal_signs(cloud, spacing, visible_points(cloud, spacing));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) wrong += cloud.normals[i].dot(truth.normals[i]) < 0;
  EXPECT_LT(static_cast<double>(wrong), .001 * static_cast<double>(cloud.size()));
}

TEST(NormalsPointInward, TellsAClosedModelInsideOut) {
  for (const std::size_t points : {1500U, 20000U}) {
    const Cloud model = test::torus(points, 1, .4);
    EXPECT_FALSE(normals_point_inward(model)) << points;
    EXPECT_TRUE(normals_point_inward(test::inside_out(model))) << points;
  }
}

TEST(NormalsPointInward, TrustsAScanOfOneSide) {
  const auto bump = test::height_field(
      20000, 1, [](double x, double y) { return .8 * std::exp(-2 * (x * x + y * y)); },
      [](double x, double y) { return Vec2(std::exp(-2 * (x * x + y * y)) * Vec2(-3.2 * x, -3.2 * y)); });
  EXPECT_FALSE(normals_point_inward(bump));
  EXPECT_TRUE(normals_point_inward(test::inside_out(bump)));
}

TEST(NormalsPointInward, IsFalseWithoutNormals) {
  EXPECT_FALSE(normals_point_inward({{Vec3::Zero()}, {}}));
}

}  // namespace
}  // namespace relievo
