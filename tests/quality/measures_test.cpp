#include "relievo/quality/measures.h"
#include "relievo/core/image.h"

#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

using test::surface_of;

// Returns the height at (x, y) of coarse and fine bumps on a square of side 2.
double bumps(double x, double y) {
  return .3 * std::sin(3 * x) * std::cos(2 * y) + .02 * std::sin(25 * x) * std::sin(20 * y);
}
Vec2 bumps_gradient(double x, double y) {
  return {.9 * std::cos(3 * x) * std::cos(2 * y) + .5 * std::cos(25 * x) * std::sin(20 * y),
          -.6 * std::sin(3 * x) * std::sin(2 * y) + .4 * std::sin(25 * x) * std::cos(20 * y)};
}

const Surface& bumpy() {
  static const Surface surface = surface_of(test::height_field(80000, 1, bumps, bumps_gradient));
  return surface;
}

std::vector<double> depths(const Surface& surface, double scale = 1) {
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(scale * p.z());
  return z;
}

template <typename F>
std::vector<double> heights(const Surface& surface, F f) {
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(f(p.x(), p.y()));
  return z;
}

TEST(Measures, OfTheModelItselfAreTheBest) {
  const Measures m = ReliefMetrics(bumpy()).measure(depths(bumpy()));
  EXPECT_GT(m.shading, .97);  // triangles between random points distort the picture
  EXPECT_LT(m.angle_deg, 1);
  for (const double detail : m.detail) EXPECT_GT(detail, .98);
  EXPECT_EQ(m.order, 1);
  EXPECT_LT(m.jump_step, 1e-12);
  EXPECT_EQ(ReliefMetrics(bumpy()).shading(depths(bumpy())), m.shading);
}

// The expected angle is the mean tilt of the points. The points are uniform in x and y, so this is also the
// mean over the picture.
TEST(Measures, AngleOfALevelReliefIsTheMeanTilt) {
  std::vector<double> level(bumpy().points.size(), 0.0);
  level[0] = 1e-6;  // gives the relief a height
  double sum = 0;
  for (const Vec3f& n : bumpy().normals) sum += std::acos(static_cast<double>(n.z()));
  const double mean_deg = sum / static_cast<double>(level.size()) * 180 / std::numbers::pi;
  EXPECT_NEAR(ReliefMetrics(bumpy()).measure(level).angle_deg, mean_deg, .02 * mean_deg);
}

TEST(Measures, LinearScalingKeepsTheOrderAndLosesTheShading) {
  const ReliefMetrics judge(bumpy());
  double last = 1;
  for (const double scale : {.5, .1, .02}) {
    const Measures m = judge.measure(depths(bumpy(), scale));
    EXPECT_EQ(m.order, 1);
    EXPECT_LT(m.shading, last);
    last = m.shading;
  }
}

TEST(Measures, UpsideDownTurnsOrderAndDetailRound) {
  const Measures m = ReliefMetrics(bumpy()).measure(depths(bumpy(), -1));
  EXPECT_EQ(m.order, 0);
  for (const double detail : m.detail) EXPECT_LT(detail, -.9);
}

TEST(Measures, NoiseLowersDetailFirstWhereItIsFine) {
  const ReliefMetrics judge(bumpy());
  std::vector<double> noisy = depths(bumpy());
  test::Random random(3);
  for (double& z : noisy) z += .002 * random.gaussian();
  const Measures m = judge.measure(noisy);
  EXPECT_LT(m.detail[0], .8);
  EXPECT_LT(m.detail[0], m.detail[1]);
  EXPECT_LT(m.detail[1], m.detail[2]);
}

TEST(Measures, HeightUsedOfARampIsItsMiddlePart) {
  const Surface sheet = surface_of(test::sheet(40000, 1, 0));
  const Measures m = ReliefMetrics(sheet).measure(heights(sheet, [](double x, double) { return x + 1; }));
  EXPECT_NEAR(m.height_used, .98, .01);
  EXPECT_NEAR(m.height, 2, .01);
}

TEST(Measures, SteepIsBeyondEightyDegrees) {
  const Surface sheet = surface_of(test::sheet(40000, 1, 0));
  const auto steep_at = [&](double degrees) {
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    return ReliefMetrics(sheet)
        .measure(heights(sheet, [&](double x, double) { return slope * x; }))
        .steep_share;
  };
  EXPECT_LT(steep_at(79), .01);
  EXPECT_GT(steep_at(81), .95);
}

TEST(Measures, JumpStepIsWhatIsLeftOfAJump) {
  const Surface sheets = surface_of(test::joined(test::sheet(40000, 1, 0), test::sheet(10000, .5, 3, 9)));
  const ReliefMetrics judge(sheets);
  EXPECT_NEAR(judge.measure(depths(sheets)).jump_step, 1, 1e-9);
  const auto ramp = heights(sheets, [](double x, double) { return x + 1; });
  EXPECT_LT(judge.measure(ramp).jump_step, .05);
}

// All points except those of the boundary have the same height. So there is a step at the silhouette, but
// no step inside, even where the front sheet extends beyond the other one.
TEST(Measures, RimStepIsTheHeightNextToTheSilhouette) {
  Cloud front = test::sheet(10000, .5, 3, 9);
  for (Vec3& p : front.points) p.x() += 1;
  const Surface sheets = surface_of(test::joined(test::sheet(40000, 1, 0), front));
  std::vector<double> z(sheets.points.size(), 2.0);
  for (std::size_t i = 0; i < z.size(); ++i)
    if (sheets.boundary.is_boundary[i]) z[i] = 0;
  const Measures m = ReliefMetrics(sheets).measure(z);
  EXPECT_EQ(m.rim_step, 1);
  EXPECT_EQ(m.jump_step, 0);
}

// Pixels near the silhouette are not measured. The points are dense, so no triangle of the step extends
// beyond the unmeasured zone.
TEST(Measures, AStepAtTheSilhouetteIsNoDetail) {
  Cloud grid;
  test::Random random(8);
  for (int i = 0; i < 200 * 200; ++i) {
    const double x = (i % 200 + random.uniform(-.1, .1)) / 100 - 1, y = i / 200 / 100. - 1;
    const Vec2 g = bumps_gradient(x, y);
    test::add(grid, {x, y, bumps(x, y)}, {-g.x(), -g.y(), 1});
  }
  const Surface surface = surface_of(grid);
  const ReliefMetrics judge(surface);
  std::vector<double> z = depths(surface, .2);
  const Measures level = judge.measure(z);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += surface.boundary.is_boundary[i] ? 0 : 1;
  const Measures stepped = judge.measure(z);
  EXPECT_GT(stepped.rim_step, .9);
  EXPECT_NEAR(stepped.angle_deg, level.angle_deg, 1e-3);
  for (std::size_t s = 0; s < level.detail.size(); ++s) EXPECT_NEAR(stepped.detail[s], level.detail[s], 1e-4);
}

TEST(Measures, AJumpIsNotMeasured) {
  const Surface sheets = surface_of(test::joined(test::sheet(40000, 1, 0), test::sheet(10000, .5, 3, 9)));
  std::vector<double> z = depths(sheets);
  for (double& value : z) value -= sheets.points[0].z();
  const Measures m = ReliefMetrics(sheets).measure(z);
  EXPECT_LT(m.angle_deg, .1);
  EXPECT_GT(m.shading, .999);
}

TEST(Measures, HaloIsABackgroundThatIsNotLevel) {
  const Surface ring = surface_of(test::torus(40000, 1, .3));
  const ReliefMetrics judge(ring);
  std::vector<double> z(ring.points.size(), 1.0);
  EXPECT_GT(judge.measure(z).halo, .1);
  for (std::size_t i = 0; i < z.size(); ++i)
    if (ring.boundary.is_boundary[i]) z[i] = 0;
  EXPECT_EQ(judge.measure(z).halo, 0);
}

TEST(Measures, OfAFlatReliefAreZero) {
  const Measures m = ReliefMetrics(bumpy()).measure(std::vector<double>(bumpy().points.size(), 0.0));
  EXPECT_EQ(m.height, 0);
  EXPECT_EQ(m.order, 0);
}

TEST(Measures, DoNotChangeWithTheUnit) {
  const Cloud cloud = test::height_field(20000, 1, bumps, bumps_gradient);
  const Surface surface = surface_of(cloud), large = surface_of(test::scaled(cloud, 1024));
  const Measures a = ReliefMetrics(surface).measure(depths(surface, .2)),
                 b = ReliefMetrics(large).measure(depths(large, .2));
  EXPECT_NEAR(a.shading, b.shading, 1e-9);
  EXPECT_NEAR(a.angle_deg, b.angle_deg, 1e-6);
  EXPECT_NEAR(a.height_used, b.height_used, 1e-9);
}

TEST(Measures, HaveTheSameBitsForAnyNumberOfThreads) {
  test::expect_same_for_any_threads([] {
    const Measures m = ReliefMetrics(bumpy()).measure(depths(bumpy(), .1));
    return std::tuple(m.shading, m.detail, m.order);
  });
}

}  // namespace
}  // namespace relievo
