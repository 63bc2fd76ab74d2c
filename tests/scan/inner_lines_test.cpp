#include "scan/outlines/outlines.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

using test::surface_of;

constexpr double half = 1;  // half of the side length of the clouds
const Vec2 across = Vec2(3, 4).normalized();

// Returns a valley or a roof. Its edge is a line through the origin, perpendicular to `across`.
Cloud fold(std::size_t n, double slope) {
  return test::height_field(
      n, half, [=](double x, double y) { return slope * std::abs(across.dot(Vec2(x, y))); },
      [=](double x, double y) -> Vec2 { return (across.dot(Vec2(x, y)) > 0 ? slope : -slope) * across; });
}

// Statistics of the points at walls, far from the silhouette. There, only the tested line has walls.
struct Walls {
  std::size_t count = 0;
  double farthest = 0;  // largest distance from the line through the origin, in rho
  double near = 0;      // fraction of the points nearer to the line than 0.6 rho
  double length = 0;    // distance between the outermost points along the line, in rho
};

Walls walls_of(const Surface& surface) {
  Walls walls;
  double least = 1e300, most = -1e300;
  for (Index i = 0; i < surface.points.size(); ++i) {
    const Vec2 at = (surface.points[i] + surface.centre).head<2>();
    if (surface.boundary.wall_side[i] == WallSide::none || at.cwiseAbs().maxCoeff() > .9 * half) continue;
    ++walls.count;
    const double off = std::abs(across.dot(at)) / surface.rho;
    walls.farthest = std::max(walls.farthest, off);
    walls.near += off < .6;
    const double along = (across.x() * at.y() - across.y() * at.x()) / surface.rho;
    least = std::min(least, along), most = std::max(most, along);
  }
  if (walls.count > 0) walls.length = most - least, walls.near /= static_cast<double>(walls.count);
  return walls;
}

TEST(InnerLines, FollowAValleyAndARoof) {
  for (const double slope : {.8, -.8}) {
    const Surface surface = surface_of(fold(20000, slope));
    const Walls walls = walls_of(surface);
    const double length = 2 * .9 * half / .8 / surface.rho;  // length of the line where walls are searched
    EXPECT_GT(walls.near, .95) << slope;
    EXPECT_LT(walls.farthest, 2) << slope;
    EXPECT_GT(walls.length, .9 * length) << slope;
    EXPECT_GT(static_cast<double>(walls.count), .9 * 2 * length / .625) << slope;
  }
}

TEST(InnerLines, FollowTheFoldOfANoisyScanWithoutNormals) {
  const Cloud exact = fold(20000, .8);
  const double rho = measure_spacing(exact).rho;
  const Walls walls = walls_of(surface_of(test::without_normals(test::noisy(exact, .15 * rho, 0))));
  EXPECT_LT(walls.farthest, 2);
  EXPECT_GT(walls.length * rho, 1.5);
}

TEST(InnerLines, FollowAStepTooLowForAJump) {
  const double rho = measure_spacing(test::sheet(20000, half, 0)).rho;
  const Surface surface = surface_of(test::height_field(
      20000, half, [=](double x, double y) { return across.dot(Vec2(x, y)) > 0 ? 1.5 * rho : 0; },
      [](double, double) { return Vec2(0, 0); }));
  const Walls walls = walls_of(surface);
  EXPECT_LT(walls.farthest, .6);
}

TEST(InnerLines, AreNotOnSmoothSurfaces) {
  const Cloud waves = test::height_field(
      20000, half, [](double x, double) { return .1 * std::sin(6 * x); },
      [](double x, double) { return Vec2(.6 * std::cos(6 * x), 0); });
  EXPECT_EQ(walls_of(surface_of(waves)).count, 0U);
  EXPECT_EQ(walls_of(surface_of(fold(20000, .15))).count, 0U);
  for (const double noise : {.1, .3}) {
    const double rho = measure_spacing(waves).rho;
    EXPECT_EQ(walls_of(surface_of(test::noisy(waves, noise * rho, .1))).count, 0U) << noise;
  }
}

// A jump becomes lower along its edge and ends inside the surface. Its wall must continue until the step is gone.
TEST(InnerLines, ContinueAJumpToItsEnd) {
  const auto step = [](double y) { return std::max(0.0, .3 * (y + .5)); };
  const Cloud flap = test::height_field(
      40000, half, [=](double x, double y) { return x > 0 ? step(y) : 0; },
      [=](double x, double y) { return Vec2(0, x > 0 && y > -.5 ? .3 : 0); });
  const Surface surface = surface_of(flap);
  double lowest = half;
  int near = 0, count = 0;
  for (Index i = 0; i < surface.points.size(); ++i) {
    const Vec2 at = (surface.points[i] + surface.centre).head<2>();
    if (surface.boundary.wall_side[i] == WallSide::none || at.cwiseAbs().maxCoeff() > .9 * half) continue;
    lowest = std::min(lowest, at.y());
    // Points behind the edge are hidden up to a distance of 2 rho. So the curve lies slightly behind the edge.
    near += at.x() > -2 * surface.rho && at.x() < .6 * surface.rho, ++count;
  }
  EXPECT_GT(near, .9 * count);
  EXPECT_LT(step(lowest), 1.5 * surface.rho);
  EXPECT_GT(lowest, -.6);
}

}  // namespace
}  // namespace relievo
