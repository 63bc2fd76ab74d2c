#include "scan/noise/noise.h"

#include "core/angle.h"
#include "core/lists.h"
#include "relievo/scan/normals.h"
#include "relievo/scan/surface.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// A cloud with noise, and the points' normals before the noise.
struct NoisyCloud {
  Cloud cloud;
  std::vector<Vec3f> truth;
};

// Moves the points along their normals by Gaussian noise. `noise` is the standard deviation in sampling
// distances. Then the normals are estimated from the moved points, but with the signs of the true normals.
NoisyCloud with_noise(Cloud cloud, double noise) {
  test::Random random(11);
  const double rho = measure_spacing(cloud).rho;
  NoisyCloud noisy{cloud, cloud.normals};
  for (std::size_t i = 0; i < cloud.size(); ++i)
    noisy.cloud.points[i] += noise * rho * random.gaussian() * cloud.normals[i].cast<double>();
  estimate_normals(noisy.cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (noisy.cloud.normals[i].dot(noisy.truth[i]) < 0) noisy.cloud.normals[i] *= -1;
  return noisy;
}

double mean_error_deg(const Cloud& cloud, const std::vector<Vec3f>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += std::acos(std::min(1.0, static_cast<double>(cloud.normals[i].dot(truth[i]))));
  return to_degrees(sum / static_cast<double>(truth.size()));
}

double noise_of(const Cloud& cloud) {
  return measure_noise(cloud, measure_spacing(cloud));
}

// Removes noise at all points of the cloud.
Cloud cleaned(Cloud cloud, double noise) {
  const Spacing spacing = measure_spacing(cloud);
  const KdTree<Vec3> tree(cloud.points);
  const std::vector<Index> all = all_indices(cloud.size());
  CleanPoints clean = without_noise({cloud, spacing, tree}, {noise, all}, nullptr);
  cloud.points = std::move(clean.points);
  cloud.normals = std::move(clean.normals);
  return cloud;
}

Cloud without_noise(const NoisyCloud& noisy) {
  return cleaned(noisy.cloud, noise_of(noisy.cloud));
}

TEST(MeasureNoise, IsZeroOnCleanShapes) {
  for (const Cloud& clean : {test::sphere(20000, 1), test::torus(20000, 2, .5), test::cube(20000)}) {
    EXPECT_EQ(noise_of(clean), 0);
    Cloud estimated = clean;
    estimate_normals(estimated);
    EXPECT_EQ(noise_of(estimated), 0);
  }
}

TEST(MeasureNoise, FindsTheDeviationThatWasAdded) {
  // measure_noise() measures in sampling distances of the noisy cloud. They are larger than those of the
  // clean cloud, and increase with the noise.
  for (const Cloud& clean : {test::sphere(20000, 1), test::torus(20000, 2, .5), test::cube(20000)})
    for (const double noise : {.15, .3, .5}) {
      const NoisyCloud noisy = with_noise(clean, noise);
      const double added = noise * measure_spacing(clean).rho / measure_spacing(noisy.cloud).rho;
      EXPECT_NEAR(noise_of(noisy.cloud), added, .2 * added) << noise;
    }
}

TEST(MeasureNoise, DoesNotDependOnScaleAndPlace) {
  const Cloud noisy = with_noise(test::sphere(5000, 1), .3).cloud;
  Cloud moved = noisy;
  for (Vec3& p : moved.points) p = 1000 * p + Vec3(1e4, -2e4, 500);
  EXPECT_NEAR(noise_of(moved), noise_of(noisy), 1e-6);
}

TEST(MeasureNoise, IsZeroForFewPointsAndWithoutNormals) {
  EXPECT_EQ(noise_of({}), 0);
  EXPECT_EQ(noise_of(with_noise(test::sphere(80, 1), .5).cloud), 0);
  EXPECT_EQ(noise_of(test::without_normals(with_noise(test::sphere(2000, 1), .5).cloud)), 0);
}

TEST(RemoveNoise, LessensTheErrorsOfNormalsAndPointsOnASphere) {
  for (const double noise : {.15, .5, 1.0}) {
    const NoisyCloud noisy = with_noise(test::sphere(20000, 1), noise);
    const Cloud clean = without_noise(noisy);
    EXPECT_LT(mean_error_deg(clean, noisy.truth), .6 * mean_error_deg(noisy.cloud, noisy.truth)) << noise;
    const auto deviation = [](const Cloud& cloud) {
      double sum = 0;
      for (const Vec3& p : cloud.points) sum += std::pow(p.norm() - 1, 2);
      return std::sqrt(sum / static_cast<double>(cloud.size()));
    };
    EXPECT_LT(deviation(clean), .6 * deviation(noisy.cloud)) << noise;
  }
}

TEST(RemoveNoise, KeepsTheRadiusOfASphereWithoutNoise) {
  // If the filter fitted constants, it would move the points inwards by about rho^2 / 2, which is 3e-4 here.
  const std::vector<Vec3f> truth = test::sphere(20000, 1).normals;
  const Cloud cloud = cleaned(test::sphere(20000, 1), .5);
  for (const Vec3& p : cloud.points) ASSERT_NEAR(p.norm(), 1, 5e-5);
  EXPECT_LT(mean_error_deg(cloud, truth), .1);
}

TEST(RemoveNoise, KeepsTheCreasesOfACube) {
  const NoisyCloud noisy = with_noise(test::cube(30000), .3);
  const Cloud clean = without_noise(noisy);
  const double rho = measure_spacing(noisy.cloud).rho;
  double before = 0, after = 0;
  std::size_t beside = 0;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    Vec3 p = noisy.cloud.points[i].cwiseAbs();
    std::ranges::sort(p);
    if (p[1] < 1 - 6 * rho || p[1] > 1 - rho) continue;  // 1 - p[1] is the distance from a crease
    ++beside;
    before += std::acos(std::min(1.F, noisy.cloud.normals[i].dot(noisy.truth[i])));
    after += std::acos(std::min(1.F, clean.normals[i].dot(noisy.truth[i])));
  }
  ASSERT_GT(beside, 1000U);
  EXPECT_LT(after, .75 * before);
}

TEST(RemoveNoise, IsNotMisledByOutliers) {
  NoisyCloud noisy = with_noise(test::sphere(20000, 1), .5);
  const double without = mean_error_deg(without_noise(noisy), noisy.truth);
  test::Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    test::add(noisy.cloud, 1.2 * p, Vec3(random.gaussian(), random.gaussian(), random.gaussian()));
  }
  EXPECT_LT(mean_error_deg(without_noise(noisy), noisy.truth), 1.05 * without);
}

TEST(SurfaceNoise, IsRemovedAsMuchAsMeasuredOrAsked) {
  const Cloud noisy = with_noise(test::sphere(20000, 1), .5).cloud;
  const auto surface_with = [&](std::optional<double> denoise) {
    View view{.denoise = denoise};
    return *find_surface(noisy, view);
  };
  const Surface measured = surface_with(std::nullopt), kept = surface_with(0), asked = surface_with(.8);
  EXPECT_NEAR(measured.measured_noise, .46, .1);
  EXPECT_EQ(measured.removed_noise, measured.measured_noise);
  EXPECT_EQ(kept.measured_noise, measured.measured_noise);
  EXPECT_EQ(kept.removed_noise, 0);
  EXPECT_EQ(asked.removed_noise, .8);
  const auto roughness = [](const Surface& surface) {
    double sum = 0;
    for (std::size_t i = 0; i < surface.points.size(); ++i)
      sum += (surface.normals[i].cast<double>() - surface.points[i].normalized()).norm();
    return sum / static_cast<double>(surface.points.size());
  };
  EXPECT_LT(roughness(measured), .6 * roughness(kept));
}

TEST(SurfaceNoise, LeavesACleanScanAsItIs) {
  const Cloud clean = test::torus(20000, 2, .5);
  View kept{.denoise = 0};
  const Surface by_itself = *find_surface(clean, View{}), untouched = *find_surface(clean, kept);
  EXPECT_EQ(by_itself.points, untouched.points);
  EXPECT_EQ(by_itself.normals, untouched.normals);
}

}  // namespace
}  // namespace relievo
