#include "relievo/scan/surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/shapes.h"

namespace relievo {
namespace {

std::string failure(const Cloud& cloud) {
  const auto surface = find_surface(cloud, {});
  if (surface) return {};
  EXPECT_EQ(surface.error().kind, ErrorKind::geometry);
  return surface.error().message();
}

TEST(Surface, RefusesWhatIsNone) {
  const Cloud line{{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 3), Vec3(7, 7, 7)}, {}};
  EXPECT_NE(failure({}).find("at least 4 points"), std::string::npos);
  EXPECT_NE(failure({std::vector<Vec3>(3, Vec3::Zero()), {}}).find("found 3"), std::string::npos);
  EXPECT_NE(failure({std::vector<Vec3>(100, Vec3(1, 2, 3)), {}}).find("equal"), std::string::npos);
  EXPECT_NE(failure(line).find("line"), std::string::npos);
}

TEST(Surface, RefusesNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Cloud cloud = test::sphere(1000, 1);
  cloud.points[7].y() = nan;
  EXPECT_NE(failure(cloud).find("point 7"), std::string::npos);
  cloud = test::sphere(1000, 1);
  cloud.normals[8].x() = static_cast<float>(nan);
  EXPECT_NE(failure(cloud).find("point 8"), std::string::npos);
  cloud.normals.pop_back();
  EXPECT_NE(failure(cloud).find("found 999"), std::string::npos);
}

// The sheet's area of 4 is covered but for its edge, though most points crowd in a hundredth of it.
TEST(Surface, CoversSparsePartsToo) {
  const auto surface =
      find_surface(test::joined(test::sheet(50000, .1, 0, 11), test::sheet(3000, 1, 0, 12)), {});
  ASSERT_TRUE(surface) << surface.error().message();
  double area = 0;
  for (std::size_t t = 0; t < surface->triangulation.triangles.size(); ++t) {
    if (!surface->boundary.is_inside[t]) continue;
    const auto& [a, b, c] = surface->triangulation.triangles[t];
    const Vec3 u = surface->points[b] - surface->points[a], v = surface->points[c] - surface->points[a];
    area += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  EXPECT_GT(area, .95 * 4);
}

TEST(Surface, RefusesACloudThatFacesAway) {
  Cloud away = test::height_field(
      5000, 1, [](double x, double y) { return .3 * x * x + .2 * y; },
      [](double x, double) { return Vec2(.6 * x, .2); });
  for (Vec3f& n : away.normals) n = -n;
  for (Vec3& p : away.points) p.z() = -p.z();
  EXPECT_NE(failure(away).find("face the viewer"), std::string::npos);
}

TEST(Surface, EstimatesNormalsAndSaysSo) {
  Cloud sphere = test::sphere(20000, 1);
  sphere.normals.clear();
  const auto surface = find_surface(sphere, {});
  ASSERT_TRUE(surface);
  EXPECT_TRUE(surface->has_estimated_normals);
  for (std::size_t i = 0; i < surface->points.size(); ++i) {
    EXPECT_GT(surface->normals[i].z(), 0);
    EXPECT_GT(surface->points[i].z(), -.2);  // the back does not shine through
  }
}

TEST(Surface, TurnsNormalsThatPointInwardsAndSaysSo) {
  Cloud sphere = test::sphere(20000, 1);
  const auto truth = find_surface(sphere, {});
  for (Vec3f& n : sphere.normals) n = -n;
  const auto surface = find_surface(sphere, {});
  ASSERT_TRUE(surface);
  EXPECT_FALSE(truth->has_flipped_normals);
  EXPECT_TRUE(surface->has_flipped_normals);
  EXPECT_EQ(surface->points.size(), truth->points.size());
}

TEST(Surface, RunsItsStagesInOrderAndCanBeCancelled) {
  std::vector<std::string> stages;
  Progress watched([&](std::string_view stage, double) { stages.emplace_back(stage); });
  const Cloud cloud = test::sphere(5000, 1);
  ASSERT_TRUE(find_surface(cloud, {}, &watched));
  EXPECT_EQ(stages, (std::vector<std::string>{"view", "spacing", "normals", "visible points", "curvature",
                                              "triangulation", "boundary"}));
  Progress* self = nullptr;
  Progress cancelled([&](std::string_view stage, double) {
    if (stage == "curvature") self->cancel();
  });
  self = &cancelled;
  const auto surface = find_surface(cloud, {}, &cancelled);
  ASSERT_FALSE(surface);
  EXPECT_EQ(surface.error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace relievo
