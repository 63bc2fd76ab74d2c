#include "relievo/scan/normals.h"

#include <gtest/gtest.h>

#include <random>

#include "core/angle.h"
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

// Returns the mean angle, in degrees, between the lines that have the directions a[i] and b[i].
double mean_angle(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += to_degrees(std::acos(std::min(1., std::abs(a[i].cast<double>().dot(b[i].cast<double>())))));
  return sum / static_cast<double>(a.size());
}

// Moves the points of a cloud along its normals by noise; `offset` is the standard deviation in sampling
// distances. Replaces the normals by axes with errors and random signs, such as Gaussian splats have.
Cloud with_noisy_axes(const Cloud& truth, double offset, double slant_deg) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const double rho = measure_spacing(truth).rho;
  Cloud cloud{truth.points, {}};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 n = truth.normals[i].cast<double>(), side = n.unitOrthogonal();
    const double slant = std::tan(to_radians(slant_deg));
    const Vec3 axis = n + slant * (normal(random) * side + normal(random) * n.cross(side));
    cloud.points[i] += offset * rho * normal(random) * n;
    cloud.axes.push_back((random() % 2 ? 1.F : -1.F) * axis.normalized().cast<float>());
  }
  return cloud;
}

TEST(EstimateNormals, OfPointsWithAxesAreBetterThanOfEitherAlone) {
  for (const Cloud& truth : {test::sphere(20000, 1), test::torus(20000, 1, .35)})
    for (const double offset : {0., .15, .6})
      for (const double slant : {5., 20.}) {
        Cloud both = with_noisy_axes(truth, offset, slant), points{both.points, {}};
        estimate_normals(both), estimate_normals(points);
        const double found = mean_angle(both.normals, truth.normals);
        EXPECT_LT(found, .4 * mean_angle(both.axes, truth.normals)) << offset << ' ' << slant;
        const double share = offset >= .6 ? .5 : 1.03;  // compared with normals from the points alone
        EXPECT_LT(found, share * mean_angle(points.normals, truth.normals)) << offset << ' ' << slant;
      }
}

// Axes in random directions must have almost no effect; zero axes must have none.
TEST(EstimateNormals, OfPointsWithWrongAxesAreThoseOfThePoints) {
  const Cloud truth = test::torus(20000, 1, .35);
  Cloud random = with_noisy_axes(truth, .15, 89.9), unknown = random, points{random.points, {}};
  unknown.axes.assign(unknown.size(), Vec3f::Zero());
  estimate_normals(random), estimate_normals(unknown), estimate_normals(points);
  EXPECT_LT(mean_angle(random.normals, truth.normals), 1.1 * mean_angle(points.normals, truth.normals));
  EXPECT_EQ(unknown.normals, points.normals);
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
