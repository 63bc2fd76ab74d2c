#include "relief/correction/height_correction.h"

#include "relievo/relief/weights.h"
#include "support/differences.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

using test::surface_of;

// Returns a level strip along y. It is so long that, far from its ends, all values depend only on x.
Surface strip(double half_width) {
  Cloud cloud = test::sheet(60000, 1, 0);
  for (Vec3& p : cloud.points) p.x() *= half_width;
  return surface_of(cloud);
}

// Returns the height of bumps on a square of side 2: 0 at the edge, and at most 0.3.
double bump(double x, double y) {
  return (1 - x * x) * (1 - y * y) * (.15 + .15 * std::sin(9 * x) * std::sin(7 * y));
}

Surface bumpy(std::size_t points = 60000) {
  return surface_of(test::height_field(points, 1, bump, [](double x, double y) -> Vec2 {
    constexpr double d = 1e-4;
    return Vec2(bump(x + d, y) - bump(x - d, y), bump(x, y + d) - bump(x, y - d)) / (2 * d);
  }));
}

std::vector<double> depths(const Surface& surface) {
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(p.z() + surface.centre.z());
  return z;
}

template <typename Real>
std::vector<Real> corrected(const Surface& surface, std::vector<Real> heights, double height) {
  const HeightCorrection correction(surface);
  HeightCorrection::Workspace workspace = correction.make_workspace();
  correction.fit(std::span<const Real>(heights), {height}, workspace);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!surface.boundary.is_boundary[i]) heights[i] += static_cast<Real>(correction.at(i, workspace));
  return heights;
}

// The heights at the centre are below the base, so the correction lifts the centre. The smaller its
// stiffness at the silhouette, the more it lifts the silhouette, too.
TEST(HeightCorrection, KeepsToTheBaseAsStifflyAsAsked) {
  const Surface surface = strip(.4);
  const HeightCorrection correction(surface);
  HeightCorrection::Workspace workspace = correction.make_workspace();
  std::vector<double> z;
  for (const Vec3& p : surface.points) z.push_back(-.1 * (1 - std::pow(p.x() / .4, 2)));
  double last = 0;
  for (const double stiffness : {1.0, .5, .1}) {
    correction.fit(std::span<const double>(z), {1, stiffness}, workspace);
    double off = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (surface.boundary.is_boundary[i]) off += static_cast<double>(correction.at(i, workspace));
    EXPECT_GT(off, 1.02 * last) << stiffness;
    last = off;
  }
}

// A dome seen along its axis is rotationally symmetric. Its correction must be symmetric, too, although
// the silhouette crosses the lattice at all angles.
TEST(HeightCorrection, IsEvenAlongARoundSilhouette) {
  const Surface surface = surface_of(test::button(60000, 1, .15));
  const HeightCorrection correction(surface);
  HeightCorrection::Workspace workspace = correction.make_workspace();
  std::vector<double> z;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double share = (surface.points[i] + surface.centre).head<2>().norm() / 1.15;
    z.push_back(surface.boundary.is_boundary[i] ? 0 : .3 * (1 - std::pow(share, 8)));
  }
  for (const double stiffness : {1.0, .1}) {
    constexpr double height = .2;
    correction.fit(std::span<const double>(z), {height, stiffness}, workspace);
    double sum = 0, squares = 0, points = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (!surface.boundary.is_boundary[i]) continue;
      const auto b = static_cast<double>(correction.at(i, workspace)) / height;
      sum += b, squares += b * b, ++points;
    }
    const double mean = sum / points;
    EXPECT_GT(mean, -.02) << stiffness;
    EXPECT_LT(mean, .1) << stiffness;
    EXPECT_LT(std::sqrt(squares / points - mean * mean), .012) << stiffness;
  }
}

TEST(HeightCorrection, TiesTheSilhouetteWhereCompressionIsWeak) {
  Shape shape = layered_shape();
  for (const auto& [share, stiffness] : {std::pair(1., 1.), {.9, .6}, {.3, .3}}) {
    shape.height_share = share;
    EXPECT_NEAR(HeightLimits::of(.1, shape).boundary_stiffness, stiffness, 1e-12) << share;
  }
  EXPECT_EQ(HeightLimits::of(.1, shape).planes, shape.planes);
}

TEST(HeightCorrection, KeepsHeightsBetweenTheBaseAndTheirHeight) {
  const Surface surface = bumpy();
  for (const double height : {.15, .2, .4}) {
    const std::vector<double> z = corrected(surface, depths(surface), height);
    std::size_t outside = 0;
    double furthest = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (surface.boundary.is_boundary[i]) continue;
      const double beyond = std::max(-z[i], z[i] - height) / height;
      outside += beyond > .03;
      furthest = std::max(furthest, beyond);
    }
    EXPECT_LT(static_cast<double>(outside), .01 * static_cast<double>(z.size())) << height;
    EXPECT_LT(furthest, .1) << height;
  }
}

// With fewer points, the cells of the lattice are wider, and the field continues across cells without points
// nearby. The heights must stay about the same, although wide cells round the distances of near pairs.
TEST(HeightCorrection, DoesNotDependOnHowManyPointsThereAre) {
  const auto mean = [](std::size_t points) {
    const Surface surface = bumpy(points);
    const std::vector<double> z = corrected(surface, depths(surface), .12);
    double sum = 0;
    for (const double value : z) sum += value;
    return sum / static_cast<double>(z.size());
  };
  const double whole = mean(60000);
  EXPECT_NEAR(mean(15000) / whole, 1, .08);
  EXPECT_NEAR(mean(2500) / whole, 1, .17);
}

// If the heights and the limit are doubled, the corrected heights must double.
TEST(HeightCorrection, IsProportionalToHeights) {
  const Surface surface = bumpy();
  std::vector<double> z = depths(surface), twice = z;
  for (double& value : twice) value *= 2;
  z = corrected(surface, z, .1), twice = corrected(surface, twice, .2);
  for (std::size_t i = 0; i < z.size(); ++i) ASSERT_NEAR(twice[i], 2 * z[i], 1e-6);
}

// Ripples finer than the lattice's cells do not change the correction, so the corrected heights must still have them.
TEST(HeightCorrection, KeepsFineDetail) {
  const Surface surface = bumpy();
  const std::vector<double> plain = depths(surface);
  std::vector<double> rippled = plain;
  const auto ripple = [&](std::size_t i) { return .002 * std::sin(400 * surface.points[i].x()); };
  for (std::size_t i = 0; i < plain.size(); ++i) rippled[i] += ripple(i);
  const std::vector<double> a = corrected(surface, plain, .15), b = corrected(surface, rippled, .15);
  double product = 0, square = 0;
  for (std::size_t i = 0; i < plain.size(); ++i)
    if (!surface.boundary.is_boundary[i])
      product += (b[i] - a[i]) * ripple(i), square += ripple(i) * ripple(i);
  EXPECT_NEAR(product / square, 1, .03);
}

// A small sheet is in front of a large one, and the heights of both are the same. The correction must
// raise the near sheet above the far one at their common edge. It must not change a level surface.
TEST(HeightCorrection, SetsNearPartsBeforeFarOnes) {
  const Surface sheets = surface_of(test::joined(test::sheet(40000, 1, 0), test::sheet(10000, .4, 3, 9)));
  const std::vector<double> z = corrected(sheets, std::vector<double>(sheets.points.size(), .05), .1);
  double inside = 0, outside = 0, insiders = 0, outsiders = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double away = sheets.points[i].head<2>().cwiseAbs().maxCoeff();
    if (away > .3 && away < .38) inside += z[i], ++insiders;
    if (away > .42 && away < .5) outside += z[i], ++outsiders;
  }
  EXPECT_GT(inside / insiders, outside / outsiders + .01);
  const Surface level = surface_of(test::sheet(40000, 1, 0));
  for (const double height : corrected(level, std::vector<double>(level.points.size(), .05), .1))
    ASSERT_NEAR(height, .05, 1e-4);
}

// At the silhouette, the field must rise to about the share `planes` of the height, even if all heights are 0.
TEST(HeightCorrection, KeepsTheSilhouetteOffTheBase) {
  const Surface surface = surface_of(test::button(60000, 1, .15));
  const HeightCorrection correction(surface);
  HeightCorrection::Workspace workspace = correction.make_workspace();
  const std::vector<double> z(surface.points.size(), 0);
  double last = -1;
  for (const double planes : {0., .05, .1, .2}) {
    correction.fit(std::span<const double>(z), {.2, .3, planes}, workspace);
    double sum = 0, points = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (surface.boundary.is_boundary[i]) sum += static_cast<double>(correction.at(i, workspace)), ++points;
    const double mean = sum / points / .2;
    EXPECT_GT(mean, .6 * planes - .001) << planes;
    EXPECT_LT(mean, planes + .02) << planes;
    EXPECT_GT(mean, last) << planes;
    last = mean;
  }
}

// The correction lifts the nearer sheet. It must bend at the depth jump where this sheet ends, and hardly elsewhere.
TEST(HeightCorrection, IsHingedAtJumps) {
  const Surface sheets = surface_of(test::joined(test::sheet(40000, 1, 0), test::sheet(10000, .4, 3, 9)));
  const std::vector<double> z = corrected(sheets, std::vector<double>(sheets.points.size(), .05), .1);
  constexpr double step = .02;
  std::vector<double> sum(40), points(40);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const Vec2 p = sheets.points[i].head<2>();
    const auto bin = static_cast<std::size_t>(std::max(p.x(), 0.0) / step);
    if (p.x() > 0 && bin < sum.size() && std::abs(p.y()) < .2) sum[bin] += z[i], ++points[bin];
  }
  const auto bend = [&](std::size_t first, std::size_t last) {
    double most = 0;
    for (std::size_t b = first; b <= last; ++b)
      most = std::max(
          most, std::abs(sum[b - 1] / points[b - 1] + sum[b + 1] / points[b + 1] - 2 * sum[b] / points[b]));
    return most;
  };
  // The ratio of the bends is 3.6, because rows of points stand beside the jump. With scattered points
  // alone, it would be above 4.
  EXPECT_GT(bend(18, 21), 3 * bend(5, 15));
  EXPECT_GT(bend(18, 21), 3 * bend(24, 34));
}

TEST(HeightCorrection, IsTheSameInSinglePrecision) {
  const Surface surface = bumpy();
  const std::vector<double> z = depths(surface), exact = corrected(surface, z, .1);
  const std::vector<float> single = corrected(surface, std::vector<float>(z.begin(), z.end()), .1);
  EXPECT_LE(test::largest_difference(single, exact), 2e-6);
}

// The boundary must stay at 0, and the relief must have exactly the requested height.
TEST(HeightCorrection, GivesHeightsTheirHeight) {
  const Surface surface = bumpy();
  const HeightCorrection correction(surface);
  HeightCorrection::Workspace workspace = correction.make_workspace();
  const std::vector<float> weight = boundary_weights(surface.boundary.distance, surface.rho);
  std::vector<double> z = depths(surface);
  for (std::size_t i = 0; i < z.size(); ++i)
    if (surface.boundary.is_boundary[i]) z[i] = 0;  // solutions of equation (9) are 0 there
  correction.compress_heights<double>({z, weight, {.15}}, workspace);
  const auto [low, high] = std::ranges::minmax(z);
  EXPECT_NEAR(high - std::min(low, 0.0), .15, 1e-12);
  for (std::size_t i = 0; i < z.size(); ++i)
    if (surface.boundary.is_boundary[i]) ASSERT_EQ(z[i], 0);
}

TEST(HeightCorrection, LeavesWhatHasNoHeight) {
  const Surface surface = strip(.5);
  const HeightCorrection correction(surface);
  HeightCorrection::Workspace workspace = correction.make_workspace();
  const std::vector<float> weight(surface.points.size(), 1);
  std::vector<float> flat(surface.points.size(), 0), some(surface.points.size(), .1F);
  correction.compress_heights<float>({flat, weight, {.1}}, workspace);
  EXPECT_EQ(flat, std::vector<float>(flat.size(), 0));
  const std::vector<float> before = some;
  correction.compress_heights<float>({some, weight, {0}}, workspace);
  EXPECT_EQ(some, before);
}

}  // namespace
}  // namespace relievo
