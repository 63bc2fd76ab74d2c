#include "scan/measured_cloud.h"

#include <gtest/gtest.h>

#include <utility>

#include "support/shapes.h"

namespace relievo {
namespace {

std::shared_ptr<const MeasuredCloud> measured(const Cloud& cloud, const View& view = {}) {
  return MeasuredCloud::measure(cloud, view).value();
}

View looking(const char* direction, double denoise) {
  View view = parse_view(direction).value();
  view.denoise = denoise;
  return view;
}

Cloud scattered_torus() {
  Cloud cloud = test::torus(20'000, 1, .4);
  test::Random random(5);
  const double noise = .3 * measure_spacing(cloud).rho;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.points[i] += noise * random.gaussian() * cloud.normals[i].cast<double>();
  return cloud;
}

// A cloud may be measured once for all views, or anew for each view. The resulting surfaces must be equal,
// bit for bit.
TEST(MeasuredCloud, GivesTheSurfaceOfEachView) {
  const Cloud cloud = scattered_torus();
  for (const double denoise : {0., .3}) {
    const auto once = measured(cloud, looking("front", denoise));
    for (const char* direction : {"front", "right", "1,2,3"}) {
      const View view = looking(direction, denoise);
      const Surface shared = find_surface(*once, view).value(), own = find_surface(cloud, view).value();
      ASSERT_EQ(shared.points.size(), own.points.size()) << direction;
      EXPECT_EQ(shared.rho, own.rho);
      EXPECT_EQ(shared.curvature.k, own.curvature.k);
      EXPECT_EQ(shared.points, own.points);
      EXPECT_EQ(shared.normals, own.normals);
    }
  }
}

// Points of a sphere are displaced along its normals by noise. The axes of the points are the normals.
TEST(MeasuredCloud, FindsNormalsFromPointsAndAxes) {
  Cloud cloud = test::sphere(20'000, 1);
  test::Random random(5);
  const double noise = .6 * measure_spacing(cloud).rho;
  cloud.axes = std::exchange(cloud.normals, {});
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.points[i] *= 1 + noise * random.gaussian();
  const auto mean_sine = [](const Cloud& scan) {
    const std::shared_ptr<const MeasuredCloud> sphere = measured(scan);
    double sum = 0;
    for (std::size_t i = 0; i < sphere->cloud().size(); ++i)
      sum += sphere->cloud().points[i].normalized().cross(sphere->cloud().normals[i].cast<double>()).norm();
    return sum / static_cast<double>(sphere->cloud().size());
  };
  EXPECT_LT(mean_sine(cloud), .5 * mean_sine({cloud.points, {}}));
}

TEST(MeasuredCloud, RemovesTheSameNoiseFromAFrontAsFromAllPoints) {
  const auto torus = measured(scattered_torus(), looking("front", .3));
  const auto all = measured(scattered_torus(), looking("front", .3))->without_noise(Vec3f::Zero());
  const auto front = torus->without_noise(Vec3f::UnitZ());
  EXPECT_LT(std::ranges::count(front->is_clean, 1), .8 * static_cast<double>(front->cloud.size()));
  for (std::size_t i = 0; i < front->cloud.size(); ++i) {
    EXPECT_TRUE(front->is_clean[i] || all->cloud.normals[i].z() <= 0);
    EXPECT_EQ(front->cloud.points[i], (front->is_clean[i] ? all->cloud : torus->cloud()).points[i]);
  }
  const auto back = torus->without_noise(-Vec3f::UnitZ());
  const auto alone = measured(scattered_torus(), looking("back", .3))->without_noise(-Vec3f::UnitZ());
  EXPECT_EQ(back->cloud.points, alone->cloud.points);
  EXPECT_EQ(back->cloud.normals, alone->cloud.normals);
  EXPECT_EQ(back->is_clean, alone->is_clean);
}

TEST(MeasuredCloud, KeepsAtMostEightPointsOfAPlace) {
  Cloud cloud = test::sphere(2'000, 1);
  const Vec3 many = cloud.points[7], few = cloud.points[1'000];
  const auto repeat = [&](std::size_t i, std::size_t times) {
    cloud.points.resize(cloud.points.size() + times, Vec3(cloud.points[i]));
    cloud.normals.resize(cloud.points.size(), Vec3f(cloud.normals[i]));
  };
  repeat(7, 500);
  repeat(1'000, 3);
  const auto sphere = measured(cloud);
  const std::vector<Vec3>& points = sphere->cloud().points;
  EXPECT_EQ(points.size(), 2'000U + 7 + 3);
  EXPECT_EQ(sphere->cloud().normals.size(), points.size());
  EXPECT_EQ(std::ranges::count(points, many - sphere->centre()), 8);
  EXPECT_EQ(std::ranges::count(points, few - sphere->centre()), 4);
}

// The coordinates are as large as UTM coordinates, millions of metres. Single precision rounds such
// coordinates to 0.5 m.
TEST(MeasuredCloud, RefusesCoordinatesThatRoundingHasSpoilt) {
  const Vec3 origin(500'000, 5'400'000, 100);
  Cloud exact = test::sphere(20'000, 2), rounded;
  for (Vec3& p : exact.points) p += origin;
  rounded = exact;
  for (Vec3& p : rounded.points) p = p.cast<float>().cast<double>();
  EXPECT_TRUE(MeasuredCloud::measure(exact, {}));
  const auto refused = MeasuredCloud::measure(rounded, {});
  ASSERT_FALSE(refused);
  const std::string text = refused.error().message();
  EXPECT_TRUE(text.contains("expected coordinates with more digits, found points ")) << text;
  EXPECT_TRUE(text.contains("in steps of 0.5")) << text;
}

TEST(MeasuredCloud, KeepsTheCurvatureOfASphere) {
  const auto sphere = measured(test::sphere(20'000, 2));
  const auto clean = sphere->without_noise(Vec3f::Zero());
  const std::vector<Index> some{3, 77, 1500};
  const std::vector<double> first = sphere->curvature(*clean, some, nullptr);
  for (const double k : first) EXPECT_NEAR(k, .5, .05);
  EXPECT_EQ(sphere->curvature(*clean, some, nullptr), first);
}

TEST(MeasuredCloud, ServesViewsThatAskForTheSameMeasures) {
  const auto whole = measured(test::torus(5'000, 1, .4));
  View view = parse_view("right").value();
  EXPECT_TRUE(whole->serves(view));
  view.denoise = .2;
  EXPECT_FALSE(whole->serves(view));
  View part;
  part.crop.most = {.5, .5};
  EXPECT_FALSE(whole->serves(part));
  const auto measured_part = measured(test::torus(5'000, 1, .4), part);
  EXPECT_TRUE(measured_part->serves(part));
  part.R_view_model = parse_view("right").value().R_view_model;
  EXPECT_FALSE(measured_part->serves(part));
}

}  // namespace
}  // namespace relievo
