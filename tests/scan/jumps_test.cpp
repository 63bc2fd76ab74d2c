#include "scan/jumps.h"

#include "support/surfaces.h"

namespace relievo {
namespace {

// Returns a level square of side 0.8 in front of a level square of side 2, at the distance `apart`. The depth
// jumps are where |x| or |y| is 0.4.
Surface sheets(double apart = 3) {
  const Cloud cloud = test::joined(test::sheet(40000, 1, 0), test::sheet(10000, .4, apart, 9));
  return test::surface_of(cloud);
}

double distance_to_jump(const Vec3& p) {
  const Vec2 a = p.head<2>().cwiseAbs();
  const double outside = (a - Vec2(.4, .4)).cwiseMax(0).norm();
  return outside > 0 ? outside : .4 - a.maxCoeff();
}

TEST(Jumps, AreWhereTheNearerSheetEnds) {
  const Surface surface = sheets();
  const std::vector<std::uint8_t> jumps = jump_triangles(surface);
  EXPECT_GT(std::ranges::count(jumps, 1), 100);
  for (std::size_t t = 0; t < jumps.size(); ++t)
    for (const Index p : surface.triangulation.triangles[t])
      if (jumps[t]) EXPECT_LT(distance_to_jump(surface.points[p]), 5 * surface.rho);
}

TEST(Jumps, OfASmoothSurfaceAreNone) {
  const Surface surface = find_surface(test::sheet(20000, 1, 0), {}).value();
  EXPECT_EQ(std::ranges::count(jump_triangles(surface), 1), 0);
}

}  // namespace
}  // namespace relievo
