#include "relievo/scan/curvature.h"

#include <numeric>

#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

struct Statistics {
  double mean = 0, deviation = 0;
};

// Returns the mean and the standard deviation of the errors of mean_curvature(). Only points for which
// `is_counted` returns true count.
template <typename Truth, typename IsCounted>
Statistics errors(const Cloud& cloud, Truth truth, IsCounted is_counted, const CurvatureOptions& options) {
  std::vector<Index> queries;
  for (Index i = 0; i < cloud.size(); ++i)
    if (is_counted(cloud.points[i])) queries.push_back(i);
  const std::vector<double> k = mean_curvature(cloud, measure_spacing(cloud), queries, options);
  double sum = 0, sum_sq = 0;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const double error = k[q] - truth(cloud.points[queries[q]]);
    sum += error;
    sum_sq += error * error;
  }
  const auto n = static_cast<double>(queries.size());
  return {sum / n, std::sqrt(std::max(0.0, sum_sq / n - sum * sum / n / n))};
}

// Expects that the magnitude of the mean error is at most `mean`, and that the standard deviation is below
// `deviation`.
void expect_small(const Statistics& errors, double mean, double deviation) {
  EXPECT_NEAR(errors.mean, 0, mean);
  EXPECT_LT(errors.deviation, deviation);
}

constexpr CurvatureOptions usual{2.5};

constexpr auto everywhere = [](const Vec3&) { return true; };

auto always(double curvature) {
  return [=](const Vec3&) { return curvature; };
}

// Returns the curvature at a point of a torus with the radii 3 and 1.
double of_torus(const Vec3& p) {
  const double cos_v = p.head<2>().norm() - 3;
  return (3 + 2 * cos_v) / (2 * (3 + cos_v));
}

Cloud saddle() {
  return test::height_field(
      20000, 1, [](double x, double y) { return .5 * (x * x - y * y); },
      [](double x, double y) { return Vec2(x, -y); });
}

bool is_in_the_middle(const Vec3& p) {
  return p.head<2>().norm() < .1;
}

// Returns the cloud with noise of half its spacing.
Cloud noisy(const Cloud& clean) {
  return test::noisy(clean, .5 * measure_spacing(clean).rho, .05);
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  for (const double radius : {1.0, 250.0})
    expect_small(errors(test::sphere(20000, radius), always(1 / radius), everywhere, usual), .01 / radius,
                 .02 / radius);
}

TEST(Curvature, OfASphereSeenFromInsideIsNegative) {
  const Cloud inside = test::inside_out(test::sphere(20000, 1));
  EXPECT_NEAR(errors(inside, always(-1), everywhere, usual).mean, 0, .01);
}

TEST(Curvature, OfACylinderIsHalfOfThat) {
  const auto is_far_from_its_ends = [](const Vec3& p) { return std::abs(p.y()) < 4; };
  expect_small(errors(test::cylinder(20000, 2, 10), always(.25), is_far_from_its_ends, usual), .0025, .0075);
}

TEST(Curvature, OfATorus) {
  expect_small(errors(test::torus(60000, 3, 1), of_torus, everywhere, usual), .005, .02);
}

TEST(Curvature, OfASaddleIsZeroInTheMiddle) {
  expect_small(errors(saddle(), always(0), is_in_the_middle, usual), .01, .03);
}

TEST(Curvature, OfAPlaneIsZero) {
  expect_small(errors(test::sheet(5000, 1, 0), always(0), everywhere, usual), 1e-12, 1e-9);
}

TEST(Curvature, SurvivesNoiseOfHalfTheSpacing) {
  const CurvatureOptions wide{5};
  const auto is_on_top = [](const Vec3& p) { return p.z() > .7; };
  const auto is_far_from_its_ends = [](const Vec3& p) { return std::abs(p.y()) < 1; };
  const auto is_at_the_right = [](const Vec3& p) { return p.x() > 3; };
  expect_small(errors(noisy(test::sphere(40000, 1)), always(1), is_on_top, wide), .05, .35);
  expect_small(errors(noisy(test::cylinder(20000, 1, 8)), always(.5), is_far_from_its_ends, wide), .05, .15);
  expect_small(errors(noisy(test::torus(40000, 3, 1)), of_torus, is_at_the_right, wide), .08, .2);
  expect_small(errors(noisy(saddle()), always(0), is_in_the_middle, wide), .1, .4);
}

TEST(Curvature, TakesAllNeighboursOfALargeScale) {
  const auto is_at_the_top = [](const Vec3& p) { return p.z() > .95; };
  expect_small(errors(test::sphere(40000, 1), always(1), is_at_the_top, {6}), .05, .1);
}

TEST(Curvature, OfTheOtherSideOfAThinWallDoesNotCount) {
  const Cloud front = test::sphere(20000, 1);
  const Cloud back = test::inside_out(test::sphere(20000, .99, 8));
  std::vector<Index> queries(front.size());
  std::iota(queries.begin(), queries.end(), Index{0});
  const Cloud both = test::joined(front, back);
  const std::vector<double> k = mean_curvature(both, measure_spacing(both), queries, usual);
  const double mean = std::accumulate(k.begin(), k.end(), 0.0) / static_cast<double>(k.size());
  EXPECT_NEAR(mean, 1, .05);
}

TEST(Curvature, IsZeroWhereThereIsNothingToFit) {
  const Cloud two{{Vec3::Zero(), Vec3::UnitX()}, {Vec3f::UnitZ(), Vec3f::UnitZ()}};
  const std::vector<Index> queries{0, 1};
  EXPECT_EQ(mean_curvature(two, measure_spacing(two), queries, usual), (std::vector<double>{0, 0}));
  EXPECT_TRUE(mean_curvature({}, {}, {}).empty());
}

TEST(Curvature, EndsEarlyWhenCancelled) {
  const Cloud cloud = test::torus(5000, 1, .4);
  const std::vector<Index> queries{0, 1, 2};
  Cancelled progress;
  EXPECT_EQ(mean_curvature(cloud, measure_spacing(cloud), queries, usual, &progress),
            (std::vector<double>{0, 0, 0}));
}

// A triangular lattice in the view plane. Its rho is 1: the area per point is 1. All normals point to the viewer.
struct Lattice {
  static constexpr Index side = 31, middle = side * side / 2;
  static constexpr double spacing_sq = 2 * std::numbers::inv_sqrt3;

  std::vector<Vec2> points;
  std::vector<Vec3f> normals{side * side, Vec3f::UnitZ()};
  Triangulation mesh;

  Lattice() {
    const double a = std::sqrt(spacing_sq);
    for (Index row = 0; row < side; ++row)
      for (Index column = 0; column < side; ++column)
        points.emplace_back(a * (column + .5 * (row % 2)), a * std::sqrt(.75) * row);
    mesh = delaunay(points);
  }

  std::vector<double> average(const std::vector<double>& values) const {
    return average_in_plane(values, points, normals, mesh, 1);
  }

  // Averages a value that is 1 at the central point and 0 elsewhere.
  std::vector<double> spread_from_the_middle() const {
    std::vector<double> one(points.size(), 0);
    one[middle] = 1;
    return average(one);
  }
};

// One pass gives each of the six neighbours, at distance a, the weight w = exp(-a^2 / rho^2); the point itself has
// weight 1. So the mean square distance after one pass is 6 w a^2 / (1 + 6 w). Three passes triple it.
TEST(AverageInPlane, SpreadsAValueByTheWidthOfThreePasses) {
  const Lattice lattice;
  const std::vector<double> spread = lattice.spread_from_the_middle();
  double sum = 0, square = 0;
  for (Index i = 0; i < spread.size(); ++i) {
    sum += spread[i];
    square += spread[i] * (lattice.points[i] - lattice.points[Lattice::middle]).squaredNorm();
  }
  const double w = std::exp(-Lattice::spacing_sq);
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(square, 3 * 6 * w * Lattice::spacing_sq / (1 + 6 * w), 1e-9);
}

TEST(AverageInPlane, KeepsWhatIsTheSameEverywhere) {
  for (const double k : Lattice().average(std::vector<double>(Lattice::side * Lattice::side, -.7)))
    EXPECT_NEAR(k, -.7, 1e-12);
}

// At a depth jump, the values of two surfaces alternate at random, because their points are mixed in the view.
TEST(AverageInPlane, LevelsValuesThatAlternate) {
  test::Random random(3);
  const Lattice lattice;
  std::vector<double> values(lattice.points.size());
  for (double& k : values) k = random.uniform() < .5 ? -1 : 1;
  double square = 0;
  for (const double k : lattice.average(values)) square += k * k / static_cast<double>(values.size());
  EXPECT_LT(std::sqrt(square), .3);
}

// The weight of a point is the point's area in the view plane. This area is 0 if the point is seen edge on.
TEST(AverageInPlane, LeavesOutWhatIsSeenEdgeOn) {
  Lattice lattice;
  lattice.normals[Lattice::middle] = Vec3f::UnitX();
  for (const double k : lattice.spread_from_the_middle()) EXPECT_EQ(k, 0);
}

TEST(Normalise, ClipsAtThe99thPercentile) {
  std::vector<double> k(1000);
  for (int i = 0; i < 1000; ++i) k[static_cast<std::size_t>(i)] = (i % 2 ? -1 : 1) * i;
  const NormalisedCurvature n = normalise(k);
  EXPECT_EQ(n.unit, 989);
  EXPECT_EQ(n.k[999], -1);
  EXPECT_FLOAT_EQ(n.k[500], 500 / 989.F);
  EXPECT_NEAR(n.delta, 1 / std::sqrt(12), .01);  // |k| is uniform in [0, 1]
}

TEST(Normalise, OfAFlatSurfaceIsZero) {
  const NormalisedCurvature n = normalise(std::vector<double>(10, 0.0));
  EXPECT_EQ(n.delta, 0);
  EXPECT_EQ(n.k, std::vector<float>(10, 0.F));
  EXPECT_TRUE(normalise({}).k.empty());
}

}  // namespace
}  // namespace relievo
