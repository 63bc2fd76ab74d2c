#include "scan/depth/organised_cloud.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "core/angle.h"

namespace relievo {
namespace {

constexpr std::size_t width = 96, height = 72;
constexpr double focal = 100;
const double nowhere = std::numeric_limits<double>::quiet_NaN();

// Returns the viewing ray of a pixel. The camera looks along z, and its y axis points down.
Vec3 ray(std::size_t pixel) {
  const auto c = static_cast<double>(pixel % width), r = static_cast<double>(pixel / width);
  return {(c - 47.5) / focal, (r - 35.5) / focal, 1};
}

// Makes the cloud of a ball of radius 0.5 at a distance of 2. Nothing is behind the ball, and the points
// have noise along the rays.
struct Ball {
  Vec3 middle{.1, -.05, 2};
  double radius = .5;

  double depth_at(std::size_t pixel) const {
    const Vec3 d = ray(pixel);
    const double a = d.squaredNorm(), b = d.dot(middle), c = middle.squaredNorm() - radius * radius;
    const double inside = b * b - a * c;
    return inside > 0 ? (b - std::sqrt(inside)) / a : nowhere;
  }

  OrganisedCloud cloud(double noise) const {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, noise);
    OrganisedCloud scan{{}, width};
    for (std::size_t i = 0; i < width * height; ++i)
      scan.cloud.points.emplace_back((depth_at(i) + (noise > 0 ? normal(random) : 0)) * ray(i));
    return scan;
  }
};

// Returns the mean distance of the points from the ball's surface. Only points that face the camera count.
double mean_distance(const std::vector<Vec3>& points, const Ball& ball) {
  double sum = 0, count = 0;
  for (const Vec3& p : points)
    if (p.allFinite() && (p - ball.middle).dot(p) < -.7 * ball.radius * p.norm())
      sum += std::abs((p - ball.middle).norm() - ball.radius), ++count;
  return sum / count;
}

TEST(SmoothOrganised, BringsANoisyBallCloserToTheTruthOnItsRays) {
  const Ball ball;
  OrganisedCloud scan = ball.cloud(.003);
  const std::vector<Vec3> before = scan.cloud.points;
  const auto done = smooth_organised(scan);
  ASSERT_TRUE(done);
  EXPECT_GT(done->noise, .1);
  EXPECT_LT(mean_distance(scan.cloud.points, ball), .5 * mean_distance(before, ball));
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!scan.cloud.points[i].allFinite()) continue;
    ASSERT_LT(scan.cloud.points[i].normalized().cross(before[i].normalized()).norm(), 1e-12);
  }
}

TEST(SmoothOrganised, GivesNormalsOfTheSurfaceThatFaceTheCamera) {
  const Ball ball;
  OrganisedCloud scan = ball.cloud(0);
  ASSERT_TRUE(smooth_organised(scan));
  std::size_t seen = 0;
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const Vec3 out = (scan.cloud.points[i] - ball.middle) / ball.radius;
    if (!out.allFinite() || out.dot(ray(i).normalized()) > -.7) continue;
    EXPECT_GT(scan.cloud.normals[i].cast<double>().dot(out), std::cos(to_radians(4))) << i;
    ++seen;
  }
  EXPECT_GT(seen, 600U);
}

// If a cloud is rotated about the camera, the smoothed cloud must be rotated in the same way.
TEST(SmoothOrganised, IsTheSameInAnyAttitude) {
  const Mat3 turn = (Eigen::AngleAxisd(2.1, Vec3::UnitX()) * Eigen::AngleAxisd(.4, Vec3::UnitZ())).matrix();
  OrganisedCloud scan = Ball().cloud(.003), turned = scan;
  for (Vec3& p : turned.cloud.points) p = turn * p;
  ASSERT_TRUE(smooth_organised(scan));
  ASSERT_TRUE(smooth_organised(turned));
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const Vec3 expected = turn * scan.cloud.points[i];
    ASSERT_EQ(expected.allFinite(), turned.cloud.points[i].allFinite()) << i;
    if (!expected.allFinite()) continue;
    ASSERT_LT((turned.cloud.points[i] - expected).norm(), 2e-4) << i;
  }
}

TEST(SmoothOrganised, LeavesPointsThatAreNoPictureAsTheyAre) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(1, 2);
  OrganisedCloud scattered{{}, width};
  for (std::size_t i = 0; i < width * height; ++i)
    scattered.cloud.points.emplace_back(any(random), any(random), any(random));
  OrganisedCloud parallel = Ball().cloud(0);  // converted to a cloud of parallel rays below
  for (std::size_t i = 0; i < parallel.cloud.size(); ++i)
    parallel.cloud.points[i].head<2>() = Vec2(ray(i).head<2>());
  OrganisedCloud ragged = Ball().cloud(0);
  ragged.cloud.points.pop_back();
  for (OrganisedCloud* scan : {&scattered, &parallel, &ragged}) {
    const Cloud before = scan->cloud;
    EXPECT_FALSE(smooth_organised(*scan));
    EXPECT_EQ(scan->cloud.size(), before.size());
    EXPECT_FALSE(scan->cloud.has_normals());
    EXPECT_TRUE(scan->cloud.points[2000] == before.points[2000] || before.points[2000].hasNaN());
  }
}

// Pictures of disparities have blurred outlines. Points of the blur must be removed, unless the option keeps them.
TEST(SmoothOrganised, TakesOutBlurUnlessItIsKept) {
  OrganisedCloud scan{{}, width};
  for (std::size_t i = 0; i < width * height; ++i) {
    const std::size_t c = i % width;
    const double group = static_cast<double>(i / width / 4);
    const double depth = c < 47 ? 100 / (100 - group) : c > 48 ? 100 / (50 - group) : c == 47 ? 1.35 : 1.7;
    scan.cloud.points.emplace_back(depth * ray(i));
  }
  OrganisedCloud keeping = scan;
  keeping.keeps_blur = true;
  const auto done = smooth_organised(scan), kept = smooth_organised(keeping);
  ASSERT_TRUE(done && kept);
  EXPECT_EQ(done->blur, 2 * height);
  EXPECT_EQ(kept->blur, 0U);
  EXPECT_TRUE(scan.cloud.points[47].hasNaN());
  EXPECT_TRUE(keeping.cloud.points[47].allFinite());
}

}  // namespace
}  // namespace relievo
