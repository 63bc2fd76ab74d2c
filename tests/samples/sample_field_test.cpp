#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "relievo/core/parallel.h"
#include "samples/sample_shapes.h"

namespace relievo::field {
namespace {

constexpr double pi = std::numbers::pi;

// The centre is not the origin, so that no cell or axis is special.
const Vec3 centre(0.31, -0.17, 0.05);
constexpr double big = 0.8, small = 0.3;

Solid sphere() {
  return {[](const Vec3& p) { return (p - centre).norm() - 1; },
          {centre - Vec3::Constant(1.01), centre + Vec3::Constant(1.02)}};
}

Solid torus() {
  const auto value = [](const Vec3& p) {
    const Vec3 q = p - centre;
    return std::hypot(std::hypot(q.x(), q.y()) - big, q.z()) - small;
  };
  return {value, {centre - Vec3::Constant(1.15), centre + Vec3::Constant(1.15)}};
}

// Returns Pearson's chi-squared statistic, minus its mean and divided by its standard deviation. It is
// between about -3 and 3 if the counts follow `expected`.
double misfit(const std::vector<double>& counts, const std::vector<double>& expected) {
  double chi_sq = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    chi_sq += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  const double freedom = static_cast<double>(counts.size()) - 1;
  return (chi_sq - freedom) / std::sqrt(2 * freedom);
}

std::size_t slot(double fraction, int slots) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(fraction * slots), 0, slots - 1));
}

TEST(Scatter, PutsPointsAndNormalsOnTheSphere) {
  const Cloud cloud = scatter(sphere(), {20000, 0, 1});
  ASSERT_EQ(cloud.points.size(), 20000U);
  ASSERT_EQ(cloud.normals.size(), 20000U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 radial = cloud.points[i] - centre;
    ASSERT_NEAR(radial.norm(), 1, 1e-7);
    ASSERT_LT((cloud.normals[i].cast<double>() - radial).norm(), 1e-5);
  }
}

TEST(Scatter, IsUniformOverTheTorus) {
  const int slots = 32;
  const Cloud cloud = scatter(torus(), {200000, 0, 3});
  std::vector<double> round_tube(slots, 0), round_axis(slots, 0), tube_area(slots);
  for (const Vec3& p : cloud.points) {
    const Vec3 q = p - centre;
    const double tube = std::atan2(q.z(), std::hypot(q.x(), q.y()) - big);
    ++round_tube[slot(tube / (2 * pi) + 0.5, slots)];
    ++round_axis[slot(std::atan2(q.y(), q.x()) / (2 * pi) + 0.5, slots)];
  }
  for (int i = 0; i < slots; ++i) {  // `share`: fraction of the area between two angles of the tube
    const double from = 2 * pi * i / slots - pi, to = from + 2 * pi / slots;
    const double share = 1.0 / slots + small / big * (std::sin(to) - std::sin(from)) / (2 * pi);
    tube_area[static_cast<std::size_t>(i)] = 200000 * share;
  }
  EXPECT_LT(std::abs(misfit(round_tube, tube_area)), 4);
  EXPECT_LT(std::abs(misfit(round_axis, std::vector<double>(slots, 200000.0 / slots))), 4);
}

TEST(Scatter, HasTheNearestNeighboursOfAPoissonProcess) {
  const std::size_t n = 4000;
  const Cloud cloud = scatter(sphere(), {n, 0, 4});
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double nearest_sq = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < n; ++j)
      if (j != i) nearest_sq = std::min(nearest_sq, (cloud.points[i] - cloud.points[j]).squaredNorm());
    sum += std::sqrt(nearest_sq);
  }
  const double spacing = std::sqrt(4 * pi / n);
  EXPECT_NEAR(sum / n, spacing / 2, 0.03 * spacing / 2);
}

// On a sphere, noise along the normals changes the radius, and tilt is the angle between the normal
// and the radial direction.
TEST(Scatter, AddsTheNoiseAskedForAlongTheNormal) {
  const std::size_t n = 100000;
  for (const double noise : {0.15, 1.0}) {
    const Cloud cloud = scatter(sphere(), {n, noise, 5});
    double sum = 0, sum_sq = 0, sum_fourth = 0, tilt_sq = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 radial = cloud.points[i] - centre;
      const double off = (radial.norm() - 1) / std::sqrt(4 * pi / n);
      sum += off, sum_sq += off * off, sum_fourth += off * off * off * off;
      tilt_sq += 1 / std::pow(cloud.normals[i].cast<double>().dot(radial.normalized()), 2) - 1;  // tan^2
      ASSERT_NEAR(cloud.normals[i].norm(), 1, 1e-6);
    }
    EXPECT_NEAR(sum / n, 0, 0.02 * noise);
    EXPECT_NEAR(std::sqrt(sum_sq / n), noise, 0.02 * noise);
    EXPECT_NEAR(sum_fourth / n / std::pow(sum_sq / n, 2), 3, 0.15) << "the kurtosis of a Gaussian";
    EXPECT_NEAR(std::sqrt(tilt_sq / n / 2), 0.2 * noise, 0.02 * noise);
  }
}

TEST(Scatter, ReturnsAnyNumberOfPoints) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, default_grain, default_grain + 1})
    EXPECT_EQ(scatter(sphere(), {n, 0.1, 6}).size(), n);
}

TEST(Scatter, ScattersOtherwiseWithAnotherSeed) {
  EXPECT_NE(scatter(sphere(), {1000, 0, 1}).points, scatter(sphere(), {1000, 0, 2}).points);
}

}  // namespace
}  // namespace relievo::field
