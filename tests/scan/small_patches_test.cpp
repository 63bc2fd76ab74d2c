#include <gtest/gtest.h>

#include "scan/outlines/outline_points.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Returns a wall with a square window, and the part of a second wall, at depth z, that is visible
// through the window. Points of both walls are 0.01 apart.
Cloud window(double half_width, double z) {
  test::Random random(3);
  Cloud cloud;
  const double step = .01;
  for (int i = 0; i < 100 * 100; ++i) {
    const Vec2 at((i % 100 - 49.5 + random.uniform(-.2, .2)) * step,
                  (i / 100 - 49.5 + random.uniform(-.2, .2)) * step);
    const bool is_window = at.cwiseAbs().maxCoeff() < half_width;
    test::add(cloud, {at.x(), at.y(), is_window ? z : 0}, Vec3::UnitZ());
  }
  return cloud;
}

std::size_t points_at(const Surface& surface, double z) {
  const auto is_there = [&](const Vec3& p) { return std::abs(p.z() + surface.centre.z() - z) < .01; };
  return static_cast<std::size_t>(std::ranges::count_if(surface.points, is_there));
}

TEST(SmallPatches, BehindOthersAreLeftOutButLargerOnesAndThoseInFrontStay) {
  const auto seen = [](double half_width, double z) {
    return points_at(*find_surface(window(half_width, z), View{}), z);
  };
  EXPECT_EQ(seen(.035, -.5), 0U);  // the patch has only about 49 points
  EXPECT_GT(seen(.1, -.5), 200U);
  EXPECT_GT(seen(.035, .5), 20U);  // a stud in front of a wall is visible
}

// A patch lies behind a wall. In the view, a gap of 3.5 spacings separates the patch from the wall's edge.
// The patch is so steep that its continuation across the gap would reach the wall, so the depths do not show
// the gap.
TEST(SmallPatches, BeyondAGapAreLeftOut) {
  Cloud cloud = window(0, 0);
  const double edge = .495, step = .01;
  for (int i = 0; i < 49; ++i) {
    const Vec2 at(edge + (i % 7 + 3.5) * step, (i / 7) * step);
    test::add(cloud, {at.x(), at.y(), -.04 - 2 * (at.x() - edge - 3.5 * step)}, Vec3(2, 0, 1).normalized());
  }
  const Surface surface = *find_surface(cloud, View{});
  for (const Vec3& p : surface.points) EXPECT_LT((p + surface.centre).x(), edge + 2 * step);
}

}  // namespace
}  // namespace relievo
