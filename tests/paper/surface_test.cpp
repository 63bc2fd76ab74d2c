#include "paper/surface.h"

#include <set>

#include "support/results.h"
#include "support/shapes.h"

namespace relievo::paper {
namespace {

Result<Surface> surface_of(const Cloud& cloud, const View& view = View().for_paper()) {
  const auto measured = value_of(MeasuredCloud::measure(cloud, view));
  return paper::find_surface(*measured, view);
}

// There must be a boundary point in each of 36 equal sectors of the rim.
TEST(PaperSurface, OfABallIsItsFrontWithTheRimAsBoundary) {
  const Surface surface = value_of(surface_of(test::sphere(20000, 1)));
  EXPECT_EQ(surface.visible_points, surface.points.size());
  EXPECT_GT(surface.points.size(), 6000U);
  std::set<int> sectors;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double radius = surface.points[i].head<2>().norm();
    if (surface.boundary.is_boundary[i]) {
      EXPECT_GT(radius, .9);
      const double turns = std::atan2(surface.points[i].y(), surface.points[i].x()) / (2 * std::numbers::pi);
      sectors.insert(static_cast<int>(std::floor(36 * turns)));
    } else if (radius < .8) {
      EXPECT_GT(surface.boundary.distance[i], .1F);
    }
    EXPECT_GT(surface.normals[i].z(), 0);
  }
  EXPECT_EQ(sectors.size(), 36U);
}

// The edge of a sheet in front of another sheet is not part of the boundary, because its points have
// neighbours on both sides.
TEST(PaperSurface, HasNoBoundaryAtDepthJumps) {
  const Surface surface =
      value_of(surface_of(test::joined(test::sheet(9000, 1, 0), test::sheet(2000, .45, .5, 9))));
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    if (surface.points[i].head<2>().cwiseAbs().maxCoeff() < .8) EXPECT_FALSE(surface.boundary.is_boundary[i]);
}

TEST(PaperSurface, RefusesWhatShowsNoArea) {
  const auto error_of = [](const Cloud& cloud) { return surface_of(cloud).error(); };
  EXPECT_EQ(error_of(test::inside_out(test::sheet(500, 1, 0))).kind, ErrorKind::geometry);
  Cloud line;  // a line of points, and one point beside it that faces away
  for (int i = 0; i < 50; ++i) test::add(line, Vec3(i, 0, 0), Vec3::UnitZ());
  test::add(line, Vec3(20, 30, -9), -Vec3::UnitZ());
  EXPECT_EQ(error_of(line).kind, ErrorKind::geometry);
}

}  // namespace
}  // namespace relievo::paper
