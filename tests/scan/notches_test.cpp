#include "scan/outlines/outline_points.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace relievo {
namespace {

constexpr double half_opening = .1;  // slope of the lips' edges against the x axis

// Returns two half cylinders of radius 0.2, like lips. Their edges cross at x = 0, and the notch between
// them opens towards +x. The upper lip is farther from the viewer by `behind`.
Cloud lips(std::size_t n, double behind) {
  test::Random random(5);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const double side = random.uniform() < .5 ? 1 : -1, angle = random.uniform(0, std::numbers::pi);
    const Vec3 along = Vec3(1, side * half_opening, 0).normalized();
    const Vec3 up(-along.y(), along.x(), 0);
    const Vec3 normal = std::cos(angle) * up + std::sin(angle) * Vec3::UnitZ();
    const Vec3 axis = random.uniform(-1, 1) * along + side * .2 * up;
    test::add(cloud, axis + .2 * normal - Vec3(0, 0, side > 0 ? behind : 0), normal);
  }
  return cloud;
}

// Returns the largest x at which a triangle inside the outline crosses the line midway between the lips.
double end_of_notch(const Surface& surface) {
  double end = -1;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = [&](std::size_t k) -> Vec3 {
        return surface.points[surface.triangulation.triangles[t][k % 3]] + surface.centre;
      };
      const Vec3 a = at(i), b = at(i + 1);
      if (a.y() * b.y() < 0) end = std::max(end, a.x() - a.y() * (b.x() - a.x()) / (b.y() - a.y()));
    }
  }
  return end;
}

TEST(Notches, BetweenTwoSurfacesAreOpenAsFarAsPointsShow) {
  for (const std::size_t n : {40000, 160000})
    for (const double behind : {.5, 0.}) {
      const Surface surface = *find_surface(lips(n, behind), View{});
      const double width = 2 * half_opening * end_of_notch(surface) / surface.rho;
      EXPECT_LT(width, 3) << behind;
      EXPECT_GT(width, 0) << behind;
    }
}

TEST(Notches, AreClosedUpToTheViewsGap) {
  double before = 0;
  for (const double gap : {2.4, 3.5, 5.0}) {
    View view{.gap = gap};
    const Surface surface = *find_surface(lips(40000, 0), view);
    const double width = 2 * half_opening * end_of_notch(surface) / surface.rho;
    EXPECT_GT(width, before + .3) << gap;
    before = width;
  }
}

}  // namespace
}  // namespace relievo
