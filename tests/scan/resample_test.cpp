#include "relievo/scan/resample.h"

#include "support/surfaces.h"

namespace relievo {
namespace {

// If heights of a plane are interpolated, the result is the same plane. Outside the triangles the height is 0.
TEST(Resample, GivesTheHeightsOfTrianglesAtOtherPoints) {
  const Surface from = test::surface_of(test::sheet(4000, 1, 0)),
                to = test::surface_of(test::sheet(3000, 1.2, 0, 9));
  const auto plane = [](const Vec3& p) { return 2 + .5 * p.x() - .25 * p.y(); };
  std::vector<double> heights;
  for (const Vec3& p : from.points) heights.push_back(plane(p + from.centre));
  const std::vector<double> there = resampled(heights, from, to);
  for (std::size_t i = 0; i < there.size(); ++i) {
    const Vec3 p = to.points[i] + to.centre;
    const double away = p.head<2>().cwiseAbs().maxCoeff();
    if (away < .95) EXPECT_NEAR(there[i], plane(p), 1e-9);
    if (away > 1.02) {
      EXPECT_EQ(there[i], 0);
    }
  }
}

}  // namespace
}  // namespace relievo
