#include "relief/baselines/normal_layers.h"

#include "support/surfaces.h"

namespace relievo {
namespace {

// Returns the normal that results from tilting the z axis by the first angle towards x, and then by the
// second angle towards y.
Vec3f leaning(double to_x, double to_y = 0) {
  const Eigen::AngleAxisd first(to_x, Vec3::UnitY()), second(-to_y, Vec3::UnitX());
  return (first * second * Vec3::UnitZ()).cast<float>();
}

void expect_near(const Vec3f& a, const Vec3f& b) {
  EXPECT_LT((a - b).norm(), 1e-5) << a.transpose() << ", " << b.transpose();
}

TEST(WeightedNormal, KeepsSharesOfAngles) {
  const Vec3f base = leaning(.8), normal = leaning(.8, .3);
  expect_near(weighted_normal(normal, base, {1, 1}), normal);
  expect_near(weighted_normal(normal, base, {1, 0}), base);
  expect_near(weighted_normal(normal, base, {.25, 0}), leaning(.2));
  expect_near(weighted_normal(normal, base, {0, 1}), leaning(0, .3));
  expect_near(weighted_normal(normal, base, {.25, .5}), leaning(.2, .15));
  expect_near(weighted_normal(base, base, {.5, 1}), leaning(.4));
}

// The base must have no fine waves, but must have a crease of 90 degrees.
TEST(BaseNormals, AreSmoothByPieces) {
  const auto slope = [](double x, double y) {
    return Vec2((x > 0 ? -1 : 1) + .1 * std::cos(80 * x), .1 * std::cos(80 * y));
  };
  const Surface surface = test::surface_of(test::height_field(
      40000, 1, [](double x, double y) { return -std::abs(x) + (std::sin(80 * x) + std::sin(80 * y)) / 800; },
      slope));
  const std::vector<Vec3f> bases = base_normals(surface, .02);
  double wave = 0, rest = 0;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    const Vec3 p = surface.points[i] + surface.centre;
    if (std::max(std::abs(p.x()), std::abs(p.y())) > .8 || std::abs(p.x()) < .02) continue;
    const Vec3f side = Vec3f(p.x() > 0 ? 1 : -1, 0, 1).normalized();
    wave += static_cast<double>((surface.normals[i] - side).squaredNorm());
    rest += static_cast<double>((bases[i] - side).squaredNorm());
  }
  EXPECT_LT(std::sqrt(rest), .15 * std::sqrt(wave));
}

TEST(BaseNormals, DoNotMixAcrossDepthJumps) {
  const auto tilted = [](double slope, double half, double z, std::uint64_t seed) {
    return test::height_field(
        static_cast<std::size_t>(20000 * half * half), half, [=](double x, double) { return z + slope * x; },
        [=](double, double) { return Vec2(slope, 0); }, seed);
  };
  const Surface surface =
      test::surface_of(test::joined(tilted(0, 1, 0, 5), tilted(.2, .5, 2, 9)), {.denoise = 0});
  const std::vector<Vec3f> bases = base_normals(surface, .05);
  for (std::size_t i = 0; i < bases.size(); ++i) {
    const bool is_front = surface.points[i].z() + surface.centre.z() > 1;
    ASSERT_LT((bases[i] - (is_front ? Vec3f(-.2F, 0, 1).normalized() : Vec3f(0, 0, 1))).norm(), .01) << i;
  }
}

}  // namespace
}  // namespace relievo
