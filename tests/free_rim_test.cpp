#include "free_rim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "relievo/parallel.h"
#include "shapes.h"

namespace relievo {
namespace {

// A square with a hole in its middle, and a ring across it: inner boundaries and a depth jump.
const Surface& figure() {
  static const Surface surface =
      find_surface(test::joined(test::sheet(6000, 1.2, -1), test::torus(6000, 1.5, .4)), {}).value();
  return surface;
}

double bowl(const Vec3& p) {
  return .3 * p.x() * p.x() - .2 * p.x() * p.y() + .1 * p.y() + 2;
}

Vec2f bowl_slope(const Vec3& p) {
  return Vec2(.6 * p.x() - .2 * p.y(), -.2 * p.x() + .1).cast<float>();
}

// The mean of two ends' slopes is exact for quadratic functions: with itself as the level, one solves the
// equations whatever the reach.
TEST(FreeRim, FindsAQuadraticFunctionExactly) {
  std::vector<Vec2f> slopes;
  std::vector<double> levels;
  for (const Vec3& p : figure().points) slopes.push_back(bowl_slope(p)), levels.push_back(bowl(p));
  for (const double reach : {.1, 2.0}) {
    const std::vector<double> z = FreeRimSystem::build(figure(), reach)->solve(slopes, levels);
    for (std::size_t i = 0; i < z.size(); ++i)
      ASSERT_NEAR(z[i], figure().boundary.is_boundary[i] ? 0 : levels[i], 1e-5);
  }
}

// Pulled hardly at all, slopes alone give it up to a constant per part that hangs together: here one.
TEST(FreeRim, DoesNotHoldTheRim) {
  const Surface square = find_surface(test::sheet(6000, 1, 0), {}).value();
  std::vector<Vec2f> slopes;
  for (const Vec3& p : square.points) slopes.push_back(bowl_slope(p));
  const std::vector<double> z = FreeRimSystem::build(square, 1e3)->solve(slopes, {});
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (square.boundary.is_boundary[i]) continue;
    const double offset = z[i] - bowl(square.points[i]);
    low = std::min(low, offset), high = std::max(high, offset);
  }
  EXPECT_LT(high - low, 1e-5);
}

TEST(FreeRim, AConstantLevelIsKept) {
  const std::vector<double> z =
      FreeRimSystem::build(figure(), .3)->solve({}, std::vector<double>(figure().points.size(), 3.0));
  for (std::size_t i = 0; i < z.size(); ++i)
    ASSERT_NEAR(z[i], figure().boundary.is_boundary[i] ? 0 : 3, 1e-9);
}

// Weights and areas from the triangles once more, edge by edge.
TEST(FreeRim, SatisfiesItsEquations) {
  const Surface& surface = figure();
  constexpr double reach = .4;
  std::vector<Vec2f> slopes;
  test::Random random(7);
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    slopes.push_back(Vec2(random.uniform(-1, 1), random.uniform(-1, 1)).cast<float>());
  const std::vector<double> z = FreeRimSystem::build(surface, reach)->solve(slopes, {});

  std::map<std::pair<Index, Index>, double> weights;
  std::vector<double> residual(z.size(), 0.0);
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    if (!surface.boundary.is_inside[t]) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const Index c = surface.triangulation.triangles[t][corner],
                  a = surface.triangulation.triangles[t][(corner + 1) % 3],
                  b = surface.triangulation.triangles[t][(corner + 2) % 3];
      const Vec2 u = (surface.points[a] - surface.points[c]).head<2>(),
                 v = (surface.points[b] - surface.points[c]).head<2>();
      const double twice_area = u.x() * v.y() - u.y() * v.x();
      weights[std::minmax(a, b)] += .5 * u.dot(v) / twice_area;
      residual[c] += twice_area / 6 / (reach * reach) * z[c];
    }
  }
  for (const auto& [edge, weight] : weights) {
    const auto [a, b] = edge;
    if (surface.boundary.is_boundary[a] || surface.boundary.is_boundary[b]) continue;
    const Vec2 step = (surface.points[a] - surface.points[b]).head<2>();
    const double wanted = .5 * (slopes[a] + slopes[b]).cast<double>().dot(step);
    const double excess = std::clamp(weight, 1e-4, 1e3) * (z[a] - z[b] - wanted);
    residual[a] += excess, residual[b] -= excess;
  }
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (surface.boundary.is_boundary[i]) continue;
    ASSERT_NEAR(residual[i], 0, 1e-6);
  }
}

}  // namespace
}  // namespace relievo
