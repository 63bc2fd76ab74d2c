#include "relievo/scan/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mls.h"
#include "support/shapes.h"

namespace relievo {
namespace {

struct Statistics {
  double mean = 0, deviation = 0;
};

// Of the estimate minus the truth at the points for which `is_counted`.
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

class Curvature : public testing::TestWithParam<CurvatureMethod> {
 protected:
  CurvatureOptions options() const { return {GetParam(), 2.5}; }
  // Of (3) on randomly scattered points; the fit does much better.
  double tolerance(double fit, double mls) const {
    return GetParam() == CurvatureMethod::normal_fit ? fit : mls;
  }
};

constexpr auto everywhere = [](const Vec3&) { return true; };

TEST_P(Curvature, OfASphereIsOneOverItsRadius) {
  for (const double radius : {1.0, 250.0}) {
    const Statistics e = errors(
        test::sphere(20000, radius), [&](const Vec3&) { return 1 / radius; }, everywhere, options());
    EXPECT_NEAR(e.mean * radius, 0, tolerance(.01, .1));
    EXPECT_LT(e.deviation * radius, tolerance(.02, .2));
  }
}

TEST_P(Curvature, OfASphereSeenFromInsideIsNegative) {
  Cloud cloud = test::sphere(20000, 1);
  for (Vec3f& n : cloud.normals) n = -n;
  const Statistics e = errors(
      cloud, [](const Vec3&) { return -1.0; }, everywhere, options());
  EXPECT_NEAR(e.mean, 0, tolerance(.01, .1));
}

TEST_P(Curvature, OfACylinderIsHalfOfThat) {
  const Statistics e = errors(
      test::cylinder(20000, 2, 10), [](const Vec3&) { return .25; },
      [](const Vec3& p) { return std::abs(p.y()) < 4; }, options());
  EXPECT_NEAR(e.mean / .25, 0, tolerance(.01, .1));
  EXPECT_LT(e.deviation / .25, tolerance(.03, .25));
}

TEST_P(Curvature, OfATorus) {
  const double R = 3, r = 1;
  const auto truth = [&](const Vec3& p) {
    const double cos_v = (p.head<2>().norm() - R) / r;
    return (R + 2 * r * cos_v) / (2 * r * (R + r * cos_v));
  };
  const Statistics e = errors(test::torus(60000, R, r), truth, everywhere, options());
  EXPECT_NEAR(e.mean, 0, tolerance(.005, .06));
  EXPECT_LT(e.deviation, tolerance(.02, .13));
}

TEST_P(Curvature, OfASaddleIsZeroInTheMiddle) {
  const Cloud saddle = test::height_field(
      20000, 1, [](double x, double y) { return .5 * (x * x - y * y); },
      [](double x, double y) { return Vec2(x, -y); });
  const Statistics e = errors(
      saddle, [](const Vec3&) { return 0.0; }, [](const Vec3& p) { return p.head<2>().norm() < .1; },
      options());
  EXPECT_NEAR(e.mean, 0, tolerance(.01, .02));
  EXPECT_LT(e.deviation, tolerance(.03, .13));
}

TEST_P(Curvature, OfAPlaneIsZero) {
  const Statistics e = errors(
      test::sheet(5000, 1, 0), [](const Vec3&) { return 0.0; }, everywhere, options());
  EXPECT_NEAR(e.mean, 0, 1e-12);
  EXPECT_LT(e.deviation, 1e-9);
}

TEST_P(Curvature, SurvivesNoiseOfHalfTheSpacing) {
  const Cloud clean = test::sphere(40000, 1);
  const double rho = measure_spacing(clean).rho;
  const Statistics e = errors(
      test::noisy(clean, .5 * rho, .05), [](const Vec3&) { return 1.0; },
      [](const Vec3& p) { return p.z() > .7; }, {GetParam(), 5});
  EXPECT_NEAR(e.mean, 0, tolerance(.05, .12));
  EXPECT_LT(e.deviation, .35);
}

TEST_P(Curvature, OfOtherShapesSurvivesThatNoiseToo) {
  const auto noisy = [](const Cloud& clean) {
    return test::noisy(clean, .5 * measure_spacing(clean).rho, .05);
  };
  const CurvatureOptions wide{GetParam(), 5};
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

TEST_P(Curvature, TakesAllNeighboursOfALargeScale) {
  const Statistics e = errors(
      test::sphere(40000, 1), [](const Vec3&) { return 1.0; }, [](const Vec3& p) { return p.z() > .95; },
      {GetParam(), 6});
  EXPECT_NEAR(e.mean, 0, .05);
  EXPECT_LT(e.deviation, .1);
}

TEST_P(Curvature, OfTheOtherSideOfAThinWallDoesNotCount) {
  const Cloud front = test::sphere(20000, 1);
  Cloud back = test::sphere(20000, .99, 8);
  for (Vec3f& n : back.normals) n = -n;
  std::vector<Index> queries(front.size());
  std::iota(queries.begin(), queries.end(), Index{0});
  const Cloud both = test::joined(front, back);
  const std::vector<double> k = mean_curvature(both, measure_spacing(both), queries, options());
  const double mean = std::accumulate(k.begin(), k.end(), 0.0) / static_cast<double>(k.size());
  EXPECT_NEAR(mean, 1, tolerance(.05, .15));
}

TEST_P(Curvature, IsZeroWhereThereIsNothingToFit) {
  const Cloud two{{Vec3::Zero(), Vec3::UnitX()}, {Vec3f::UnitZ(), Vec3f::UnitZ()}};
  const std::vector<Index> queries{0, 1};
  EXPECT_EQ(mean_curvature(two, measure_spacing(two), queries, options()), (std::vector<double>{0, 0}));
  EXPECT_TRUE(mean_curvature({}, {}, {}).empty());
}

INSTANTIATE_TEST_SUITE_P(Methods, Curvature,
                         testing::Values(CurvatureMethod::normal_fit, CurvatureMethod::mls_surface),
                         [](const auto& method) {
                           return method.param == CurvatureMethod::normal_fit ? "Fit" : "Mls";
                         });

// The closed form of the derivatives against differences of the function itself.
TEST(Mls, DerivativesAgreeWithDifferences) {
  test::Random random(7);
  const double h = 1.3;
  std::vector<MlsSample> samples;
  for (int i = 0; i < 30; ++i) {
    const Vec3 q(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-.3, .3));
    samples.push_back(
        {-q, (Vec3::UnitZ() + .5 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0)).normalized()});
  }
  // g times the sum of weights: what the gradient is the derivative of.
  const auto unscaled = [&](const Vec3& x) {
    std::vector<MlsSample> moved = samples;
    double total = 0;
    for (MlsSample& s : moved) {
      s.d += x;
      total += std::exp(-s.d.squaredNorm() / (h * h));
    }
    const MlsValue value = mls_function(moved, h);
    return std::tuple(value.g * total, Vec3(value.gradient * total), Mat3(value.hessian * total));
  };
  const auto [g, gradient, hessian] = unscaled(Vec3::Zero());
  const double step = 1e-4;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 dx = step * Vec3::Unit(axis);
    const auto [g1, gradient1, hessian1] = unscaled(dx);
    const auto [g0, gradient0, hessian0] = unscaled(-dx);
    EXPECT_NEAR((g1 - g0) / (2 * step), gradient[axis], 1e-5);
    EXPECT_LT(((gradient1 - gradient0) / (2 * step) - hessian.col(axis)).norm(), 1e-4);
  }
}

TEST(Normalise, ClipsAtThe99thPercentile) {
  std::vector<double> k(1000);
  for (int i = 0; i < 1000; ++i) k[static_cast<std::size_t>(i)] = (i % 2 ? -1 : 1) * i;
  const NormalisedCurvature n = normalise(k);
  EXPECT_EQ(n.unit, 989);
  EXPECT_EQ(n.k[999], -1);
  EXPECT_FLOAT_EQ(n.k[500], 500 / 989.F);
  EXPECT_NEAR(n.delta, 1 / std::sqrt(12), .01);  // |k| is spread evenly over [0, 1]
}

TEST(Normalise, OfAFlatSurfaceIsZero) {
  const NormalisedCurvature n = normalise(std::vector<double>(10, 0.0));
  EXPECT_EQ(n.delta, 0);
  EXPECT_EQ(n.k, std::vector<float>(10, 0.F));
  EXPECT_TRUE(normalise({}).k.empty());
}

}  // namespace
}  // namespace relievo
