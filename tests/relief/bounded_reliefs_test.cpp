#include "relief/baselines/bounded_reliefs.h"

#include "relievo/relief/heights.h"
#include "relievo/relief/weights.h"
#include "support/differences.h"
#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

// Returns a hill of the given height on a square around the origin, at depth z. `half` is half the side.
Cloud hill(double height, double half, double z, std::uint64_t seed) {
  const auto f = [=](double x, double y) { return height * std::exp(-8 * (x * x + y * y) / (half * half)); };
  return test::height_field(
      static_cast<std::size_t>(20000 * half * half), half, [=](double x, double y) { return z + f(x, y); },
      [=](double x, double y) { return Vec2(-16 / (half * half) * f(x, y) * Vec2(x, y)); }, seed);
}

std::vector<double> mimicking(const Surface& surface, double height) {
  return value_of(mimicking_heights(surface, height));
}

// If the silhouette of a model is level and the height is sufficient, the relief equals the model. The
// solver stops when the energy is almost minimal, so level parts may be slightly above the lower bound.
TEST(Mimicking, WithEnoughHeightIsTheModel) {
  const Surface surface = test::surface_of(hill(.4, 1, 0, 5));
  std::vector<double> expected;
  const double ground = Box::of(surface.points).min.z();
  for (const Vec3& p : surface.points) expected.push_back(p.z() - ground);
  const std::vector<double> heights = mimicking(surface, .6);
  EXPECT_LE(test::root_mean_square(heights, expected), .005);
  EXPECT_LE(test::largest_difference(heights, expected), .02);
}

TEST(Mimicking, UsesTheHeightAndNoMore) {
  const Surface surface = test::surface_of(test::torus(20000, 1, .4));
  const std::vector<double> heights = mimicking(surface, .05);
  EXPECT_GE(std::ranges::min(heights), 0);
  EXPECT_LE(std::ranges::max(heights), .05);
  EXPECT_GT(std::ranges::max(heights), .0499);
  for (std::size_t i = 0; i < heights.size(); ++i)
    ASSERT_TRUE(!surface.boundary.is_boundary[i] || heights[i] == 0);
}

// A piece in front of another one uses the whole height, however far in front it is.
TEST(Mimicking, MovesPiecesFreely) {
  std::vector<std::vector<double>> heights;
  for (const double distance : {1.0, 3.0}) {
    const Surface surface =
        test::surface_of(test::joined(hill(.4, 1, 0, 5), hill(.2, .5, distance, 9)), {.denoise = 0});
    heights.push_back(mimicking(surface, .05));
  }
  EXPECT_LE(test::largest_difference(heights[0], heights[1]), 1e-3 * .05);
}

TEST(Mimicking, HasTheSameBitsForAnyNumberOfThreads) {
  const Surface surface = test::surface_of(test::bumps_behind_a_ring(10000));
  test::expect_same_for_any_threads([&] { return mimicking(surface, .05); });
}

// If heights do not reach a bound, they are the heights of equation (9) without bounds.
TEST(Bounded, WithEnoughHeightSolvesTheEquations) {
  const Surface surface = test::surface_of(test::sphere(20000, 1));
  const HeightSystem system =
      value_of(HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary));
  std::vector<Vec2> slopes;
  for (const Vec3f& n : surface.normals) slopes.push_back(compressed_slope(Vec3(n.cast<double>()), .3, 4.0));
  std::vector<double> expected(slopes.size());
  system.solve(slopes, expected);
  const double highest = std::ranges::max(expected);
  const std::vector<double> heights = value_of(bounded_heights(surface, 2 * highest, .3));
  EXPECT_LE(test::root_mean_square(heights, expected), .005 * highest);
}

TEST(Bounded, KeepsTheHeight) {
  const Surface surface = test::surface_of(test::sphere(20000, 1));
  const auto [low, high] = std::ranges::minmax(value_of(bounded_heights(surface, .05, 1)));
  EXPECT_GE(low, 0);
  EXPECT_LE(high, .05);
  EXPECT_GT(high, .0499);
}

}  // namespace
}  // namespace relievo
