#include "relievo/scan/curvature.h"

#include <numeric>

#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

struct Statistics {
  double mean = 0, deviation = 0;
};

// Returns the mean and the standard deviation of the errors of mean_curvature(), at the points for which
// `is_counted` returns true.
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

constexpr CurvatureOptions usual{2.5};

constexpr auto everywhere = [](const Vec3&) { return true; };

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  for (const double radius : {1.0, 250.0}) {
    const Statistics e = errors(
        test::sphere(20000, radius), [&](const Vec3&) { return 1 / radius; }, everywhere, usual);
    EXPECT_NEAR(e.mean * radius, 0, .01);
    EXPECT_LT(e.deviation * radius, .02);
  }
}

TEST(Curvature, OfASphereSeenFromInsideIsNegative) {
  const Statistics e = errors(
      test::inside_out(test::sphere(20000, 1)), [](const Vec3&) { return -1.0; }, everywhere, usual);
  EXPECT_NEAR(e.mean, 0, .01);
}

TEST(Curvature, OfACylinderIsHalfOfThat) {
  const Statistics e = errors(
      test::cylinder(20000, 2, 10), [](const Vec3&) { return .25; },
      [](const Vec3& p) { return std::abs(p.y()) < 4; }, usual);
  EXPECT_NEAR(e.mean / .25, 0, .01);
  EXPECT_LT(e.deviation / .25, .03);
}

TEST(Curvature, OfATorus) {
  const double R = 3, r = 1;
  const auto truth = [&](const Vec3& p) {
    const double cos_v = (p.head<2>().norm() - R) / r;
    return (R + 2 * r * cos_v) / (2 * r * (R + r * cos_v));
  };
  const Statistics e = errors(test::torus(60000, R, r), truth, everywhere, usual);
  EXPECT_NEAR(e.mean, 0, .005);
  EXPECT_LT(e.deviation, .02);
}

TEST(Curvature, OfASaddleIsZeroInTheMiddle) {
  const Cloud saddle = test::height_field(
      20000, 1, [](double x, double y) { return .5 * (x * x - y * y); },
      [](double x, double y) { return Vec2(x, -y); });
  const Statistics e = errors(
      saddle, [](const Vec3&) { return 0.0; }, [](const Vec3& p) { return p.head<2>().norm() < .1; }, usual);
  EXPECT_NEAR(e.mean, 0, .01);
  EXPECT_LT(e.deviation, .03);
}

TEST(Curvature, OfAPlaneIsZero) {
  const Statistics e = errors(
      test::sheet(5000, 1, 0), [](const Vec3&) { return 0.0; }, everywhere, usual);
  EXPECT_NEAR(e.mean, 0, 1e-12);
  EXPECT_LT(e.deviation, 1e-9);
}

TEST(Curvature, SurvivesNoiseOfHalfTheSpacing) {
  const Cloud clean = test::sphere(40000, 1);
  const double rho = measure_spacing(clean).rho;
  const Statistics e = errors(
      test::noisy(clean, .5 * rho, .05), [](const Vec3&) { return 1.0; },
      [](const Vec3& p) { return p.z() > .7; }, {5});
  EXPECT_NEAR(e.mean, 0, .05);
  EXPECT_LT(e.deviation, .35);
}

TEST(Curvature, OfOtherShapesSurvivesThatNoiseToo) {
  const auto noisy = [](const Cloud& clean) {
    return test::noisy(clean, .5 * measure_spacing(clean).rho, .05);
  };
  const CurvatureOptions wide{5};
  const Statistics cylinder = errors(
      noisy(test::cylinder(20000, 1, 8)), [](const Vec3&) { return .5; },
      [](const Vec3& p) { return std::abs(p.y()) < 1; }, wide);
  EXPECT_NEAR(cylinder.mean, 0, .05);
  EXPECT_LT(cylinder.deviation, .15);
  const auto truth = [](const Vec3& p) {
    const double cos_v = p.head<2>().norm() - 3;
    return (3 + 2 * cos_v) / (2 * (3 + cos_v));
  };
  const Statistics torus = errors(
      noisy(test::torus(40000, 3, 1)), truth, [](const Vec3& p) { return p.x() > 3; }, wide);
  EXPECT_NEAR(torus.mean, 0, .08);
  EXPECT_LT(torus.deviation, .2);
  const Statistics saddle = errors(
      noisy(test::height_field(
          20000, 1, [](double x, double y) { return .5 * (x * x - y * y); },
          [](double x, double y) { return Vec2(x, -y); })),
      [](const Vec3&) { return 0.0; }, [](const Vec3& p) { return p.head<2>().norm() < .1; }, wide);
  EXPECT_NEAR(saddle.mean, 0, .1);
  EXPECT_LT(saddle.deviation, .4);
}

TEST(Curvature, TakesAllNeighboursOfALargeScale) {
  const Statistics e = errors(
      test::sphere(40000, 1), [](const Vec3&) { return 1.0; }, [](const Vec3& p) { return p.z() > .95; },
      {6});
  EXPECT_NEAR(e.mean, 0, .05);
  EXPECT_LT(e.deviation, .1);
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

// A triangular lattice in the view plane with rho = 1, so the area per point is 1. All normals point to the
// viewer.
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

// One pass gives each of the six neighbours at distance a the weight w = exp(-a^2 / rho^2), relative to the
// weight of the point itself. So the mean square distance is 6 w a^2 / (1 + 6 w); three passes triple it.
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

// At a depth jump, values from two surfaces alternate at random.
TEST(AverageInPlane, LevelsValuesThatAlternate) {
  test::Random random(3);
  const Lattice lattice;
  std::vector<double> values(lattice.points.size());
  for (double& k : values) k = random.uniform() < .5 ? -1 : 1;
  double square = 0;
  for (const double k : lattice.average(values)) square += k * k / static_cast<double>(values.size());
  EXPECT_LT(std::sqrt(square), .3);
}

// The weight of a point is its area in the view plane, which is 0 for a point that is seen edge on.
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
