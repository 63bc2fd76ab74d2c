#include <gtest/gtest.h>

#include <cmath>

#include "core/simd.h"
#include "scan/measured_cloud.h"
#include "scan/turning/turned_surface.h"
#include "support/shapes.h"

namespace relievo {
namespace {

TurnedSurface turned(const Cloud& cloud, const View& view = {}) {
  return turned_surface(TurningScan(*MeasuredCloud::measure(cloud, {}).value()), view, 5'000).value();
}

TEST(TurnedSurface, LiesOnTheSphere) {
  const TurnedSurface sphere = turned(test::sphere(60'000, 1), parse_view("1,1,1").value());
  ASSERT_GT(sphere.surface.points.size(), 3'000U);
  for (std::size_t i = 0; i < sphere.surface.points.size(); ++i) {
    const Vec3& p = sphere.surface.points[i];
    if (p.head<2>().norm() > .9) continue;  // nearly edge on, where a cell is deep
    EXPECT_NEAR(p.norm(), 1, .02);
    EXPECT_GT(sphere.surface.normals[i].cast<double>().dot(p.normalized()), .998);
  }
}

// The front sheet hides the one behind, and the covered area is that of the larger.
TEST(FrontCells, ShowsWhatIsInFront) {
  const TurnedSurface sheets =
      turned(test::joined(test::sheet(40'000, 1, 0, 5), test::sheet(20'000, .5, .7, 6)));
  const FrontCells& front = sheets.front;
  double area = 0;
  for (int y = 0; y < front.depth.height; ++y)
    for (int x = 0; x < front.depth.width; ++x) {
      if (!front.is_covered(x, y)) continue;
      area += static_cast<double>(front.cell * front.cell);
      const Vec2f place = front.centre(x, y).cwiseAbs();
      const float reach = place.maxCoeff();
      if (std::abs(reach - .5F) < .05F) continue;  // next to the jump
      EXPECT_NEAR(front.depth.at(x, y), reach < .5F ? .35F : -.35F, 1e-4F);
    }
  EXPECT_NEAR(area, 4, .15);
}

TEST(FrontCells, HasTheSameBitsWithAndWithoutWideVectors) {
  const Cloud cloud = test::torus(30'000, 1, .4);
  allow_avx2(false);
  const TurnedSurface plain = turned(cloud, parse_view("1,2,3").value());
  allow_avx2(true);
  const TurnedSurface wide = turned(cloud, parse_view("1,2,3").value());
  EXPECT_EQ(plain.front.depth.pixels, wide.front.depth.pixels);
  EXPECT_EQ(plain.front.normal.pixels, wide.front.normal.pixels);
}

TEST(FrontCells, MarksTheEdgesOfAJump) {
  const TurnedSurface sheets =
      turned(test::joined(test::sheet(40'000, 1, 0, 5), test::sheet(20'000, .5, .7, 6)));
  const FrontCells& front = sheets.front;
  std::size_t edges = 0;
  for (int y = 0; y < front.depth.height; ++y)
    for (int x = 0; x < front.depth.width; ++x) {
      if (!front.is_edge.at(x, y)) continue;
      const double reach = static_cast<double>(front.centre(x, y).cwiseAbs().maxCoeff());
      EXPECT_TRUE(std::abs(reach - .5) < .05 || std::abs(reach - 1) < .05) << reach;
      ++edges;
    }
  EXPECT_GT(edges, static_cast<std::size_t>(4 / front.cell));
}

}  // namespace
}  // namespace relievo
