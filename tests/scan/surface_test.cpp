#include "relievo/scan/surface.h"

#include <limits>

#include "support/surfaces.h"
#include "support/triangles.h"

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
  EXPECT_TRUE(failure({}).contains("at least 4 points"));
  EXPECT_TRUE(failure({std::vector<Vec3>(3, Vec3::Zero()), {}}).contains("found 3"));
  EXPECT_TRUE(failure({std::vector<Vec3>(100, Vec3(1, 2, 3)), {}}).contains("equal"));
  EXPECT_TRUE(failure(line).contains("line"));
}

TEST(Surface, RefusesNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Cloud cloud = test::sphere(1000, 1);
  cloud.points[7].y() = nan;
  EXPECT_TRUE(failure(cloud).contains("point 7"));
  cloud = test::sphere(1000, 1);
  cloud.normals[8].x() = static_cast<float>(nan);
  EXPECT_TRUE(failure(cloud).contains("point 8"));
  cloud.normals.pop_back();
  EXPECT_TRUE(failure(cloud).contains("found 999"));
}

// Most points are in a hundredth of the sheet. Nevertheless the whole area of the sheet, 4, must be
// covered, except at its edge.
TEST(Surface, CoversSparsePartsToo) {
  const Surface surface =
      test::surface_of(test::joined(test::sheet(50000, .1, 0, 11), test::sheet(3000, 1, 0, 12)));
  EXPECT_GT(test::inside_area(surface.points, surface.triangulation, surface.boundary), .95 * 4);
}

TEST(Surface, RefusesACloudThatFacesAway) {
  Cloud away = test::height_field(
      5000, 1, [](double x, double) { return .3 * x * x; }, [](double x, double) { return Vec2(.6 * x, 0); });
  for (Vec3& p : away.points) p.z() = -p.z();
  const std::string message = failure(test::inside_out(away));
  EXPECT_TRUE(message.contains("found 100 % of the surface facing away")) << message;
  EXPECT_TRUE(message.contains("--view back or --view auto")) << message;
}

// A camera at the origin has scanned the near half of a ball, and a little of the far half. The camera's y axis points
// down, its z axis away from the viewer. In the front view, only points of the far half would be visible.
TEST(Surface, NamesTheSideThatWasScanned) {
  const auto is_scanned = [](const Vec3& p) { return p.z() < .2; };
  Cloud scan = test::where(test::sphere(20'000, 1), is_scanned);
  for (Vec3& p : scan.points) p.z() += 5;
  EXPECT_TRUE(failure(scan).contains("--view back --up 0,-1,0 or --view auto")) << failure(scan);
  EXPECT_TRUE(find_surface(scan, *parse_view("back", "0,-1,0")));
  for (const char* side : {"left", "right", "top", "bottom"})
    EXPECT_TRUE(find_surface(scan, *parse_view(side))) << side;
}

TEST(Surface, EstimatesNormalsAndSaysSo) {
  const Surface surface = test::surface_of(test::without_normals(test::sphere(20000, 1)));
  EXPECT_TRUE(surface.has_estimated_normals);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    EXPECT_GT(surface.normals[i].z(), 0);
    EXPECT_GT(surface.points[i].z(), -.2);  // no point of the back is visible
  }
}

TEST(Surface, TurnsNormalsThatPointInwardsAndSaysSo) {
  const Cloud sphere = test::sphere(20000, 1);
  const Surface truth = test::surface_of(sphere), surface = test::surface_of(test::inside_out(sphere));
  EXPECT_FALSE(truth.has_flipped_normals);
  EXPECT_TRUE(surface.has_flipped_normals);
  EXPECT_EQ(surface.points.size(), truth.points.size());
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
  expect_error(find_surface(cloud, {}, &cancelled), ErrorKind::cancelled);
}

}  // namespace
}  // namespace relievo
