#include "scan/jumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "relief/membrane/height_correction.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"
#include "support/differences.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

// Returns a level square of side .8 at the distance `apart` before one of side 2. The depth jumps where |x|
// or |y| is .4.
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
      if (jumps[t]) {
        EXPECT_LT(distance_to_jump(surface.points[p]), 5 * surface.rho);
      }
}

// The weight is .2 at a jump and grows geometrically to 1 at a distance of .8 % of the surface's longer side,
// which is 2. The test finds the distance to the nearest jump by brute force.
TEST(Jumps, CountLessTheNearer) {
  const Surface surface = sheets();
  const std::vector<std::uint8_t> jumps = jump_triangles(surface);
  std::vector<Vec2> ends;
  for (std::size_t t = 0; t < jumps.size(); ++t)
    for (const Index p : surface.triangulation.triangles[t])
      if (jumps[t]) ends.push_back(surface.points[p].head<2>());
  const std::vector<float> weights = jump_weights(surface);
  int below = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    double nearest = 1;
    for (const Vec2& end : ends) nearest = std::min(nearest, (surface.points[i].head<2>() - end).norm());
    const double share = std::min(nearest / (.008 * 2), 1.0);
    ASSERT_NEAR(static_cast<double>(weights[i]), std::pow(.2, 1 - share), 1e-3);
    below += weights[i] > .21F && weights[i] < .99F;
  }
  EXPECT_GT(below, 100);
}

// A jump that is lower than 2 % of the longer side, here .04, leaves all weights at 1.
TEST(Jumps, ThatAreLowCountInFull) {
  const Surface low = sheets(.036), high = sheets(.044);
  for (const Surface* surface : {&low, &high})
    EXPECT_GT(std::ranges::count(jump_triangles(*surface), 1), 100);
  EXPECT_EQ(jump_weights(low), std::vector<float>(low.points.size(), 1));
  EXPECT_NE(jump_weights(high), std::vector<float>(high.points.size(), 1));
}

TEST(Jumps, AreWhatModelsHeightsAndMembranesYieldAt) {
  const Surface surface = sheets();
  const std::size_t n = surface.points.size();
  const ReliefModel model = ReliefModel::prepare(surface).value();
  const auto heights = [&](const std::vector<float>& weights) {
    std::vector<Vec2> slopes(n);
    for (std::size_t i = 0; i < n; ++i)
      slopes[i] = {std::sin(9 * surface.points[i].y()), surface.points[i].z()};
    std::vector<double> z(n);
    HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary, weights)
        .value()
        .solve(slopes, z);
    std::vector<double> own(n);
    model.system()->solve(slopes, own);
    return test::largest_difference(z, own);
  };
  EXPECT_EQ(heights(jump_weights(surface)), 0);
  EXPECT_GT(heights({}), 1e-3);
}

// The correction is pulled up in the middle and down around it. If it is less stiff at the jump between them,
// it makes a higher step there.
TEST(Jumps, LetTheMembraneStep) {
  const Surface surface = sheets();
  const auto step = [&](std::span<const float> weights) {
    const HeightCorrection correction(surface, weights);
    HeightCorrection::Workspace workspace = correction.make_workspace();
    const std::vector<double> z(surface.points.size(), .05);
    correction.fit(std::span(z), {.1, .085}, workspace);
    double inside = 0, outside = 0, insiders = 0, outsiders = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double far = surface.points[i].head<2>().cwiseAbs().maxCoeff();
      const auto b = static_cast<double>(correction.at(i, workspace));
      if (far > .35 && far < .37) inside += b, ++insiders;
      if (far > .43 && far < .45) outside += b, ++outsiders;
    }
    return inside / insiders - outside / outsiders;
  };
  const std::vector<float> even(surface.points.size(), 1);
  EXPECT_GT(step(jump_weights(surface)), 1.2 * step(even));
}

TEST(Jumps, OfASmoothSurfaceAreNone) {
  const Surface surface = find_surface(test::sheet(20000, 1, 0), {}).value();
  EXPECT_EQ(std::ranges::count(jump_triangles(surface), 1), 0);
  EXPECT_EQ(jump_weights(surface), std::vector<float>(surface.points.size(), 1));
}

}  // namespace
}  // namespace relievo
