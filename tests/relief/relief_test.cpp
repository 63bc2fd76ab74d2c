#include "relievo/relief/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "relievo/core/parallel.h"
#include "relievo/scan/surface.h"
#include "support/shapes.h"

namespace relievo {
namespace {

const Compression keep_all{std::numeric_limits<double>::infinity(), 0};

ReliefModel model_of(const Cloud& cloud, const View& view = {}) {
  return ReliefModel::prepare(find_surface(cloud, view).value()).value();
}

// A bumpy figure with an occluding ring: curvature of both signs, a depth jump, an inner hole.
Cloud figure(std::size_t n = 30000) {
  Cloud bumps = test::height_field(
      n, 1.2, [](double x, double y) { return .2 * std::sin(5 * x) * std::cos(4 * y) - 1; },
      [](double x, double y) {
        return Vec2(std::cos(5 * x) * std::cos(4 * y), -.8 * std::sin(5 * x) * std::sin(4 * y));
      });
  Cloud ring = test::torus(n, 1.5, .4);
  return test::joined(bumps, ring);
}

// Heights by place, for clouds whose points are numbered differently: largest difference at the same x, y.
double largest_difference(const ReliefModel& a, const Relief& ra, const ReliefModel& b, const Relief& rb,
                          double scale) {
  const auto sorted = [](const ReliefModel& model, const Relief& relief, double factor) {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < relief.heights.size(); ++i) {
      const Vec3& p = model.surface().points[i];
      out.push_back(factor * Vec3(p.x(), p.y(), relief.heights[i]));
    }
    std::sort(out.begin(), out.end(),
              [](const Vec3& p, const Vec3& q) { return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y()); });
    return out;
  };
  const std::vector<Vec3> pa = sorted(a, ra, scale), pb = sorted(b, rb, 1);
  if (pa.size() != pb.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t i = 0; i < pa.size(); ++i) worst = std::max(worst, (pa[i] - pb[i]).norm());
  return worst;
}

TEST(Relief, OfAPlaneIsFlat) {
  for (const double w : {0.0, std::numeric_limits<double>::infinity()})
    EXPECT_NEAR(model_of(test::sheet(3000, 1, 2)).make({{w, 0}, .04}).height, 0, 1e-12);
}

TEST(Relief, OfATiltedPlaneIsFlatWhereNothingIsKept) {
  const Cloud tilted = test::height_field(
      3000, 1, [](double x, double) { return .5 * x; }, [](double, double) { return Vec2(.5, 0); });
  const ReliefModel model = model_of(tilted);
  EXPECT_NEAR(model.make({{0, 0}, 0}).height, 0, 1e-12);
  // Kept in full, the least squares share out a slope that cannot hold with both ends on the base.
  EXPECT_LT(model.make({keep_all, 0}).height, .2);
}

// Up to a constant: the rim's steepest two rho belong to the boundary weight.
TEST(Relief, OfAHemisphereKeptInFullIsTheHemisphere) {
  const ReliefModel model = model_of(test::sphere(120000, 1));
  const Relief relief = model.make({keep_all, 0, 100});
  const auto [lowest, highest] = [&] {
    double low = 1, high = -1;
    for (std::size_t i = 0; i < relief.heights.size(); ++i) {
      if (model.surface().points[i].head<2>().norm() > .9) continue;
      const double offset = relief.heights[i] - model.surface().points[i].z();
      low = std::min(low, offset), high = std::max(high, offset);
    }
    return std::pair(low, high);
  }();
  EXPECT_LT(highest - lowest, .01);
  EXPECT_NEAR(relief.height, 1, .25);
}

TEST(Relief, StandsOnTheBaseAtItsBoundary) {
  const ReliefModel model = model_of(figure());
  const Relief relief = model.make({{1, 0}, .04});
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    ASSERT_TRUE(!model.surface().boundary.is_boundary[i] || relief.heights[i] == 0);
}

TEST(Relief, RisesWithU) {
  const ReliefModel model = model_of(figure());
  double last = 0;
  for (const double u : {.05, .2, 1.0, 3.0}) {
    const double height = model.make({{u, 0}, .02}).height;
    EXPECT_GT(height, last);
    last = height;
  }
}

// Names a case by its height, in millionths of the diagonal, and its beta, in hundredths.
std::string share_and_beta(const testing::TestParamInfo<std::tuple<double, double>>& test) {
  const auto [share, beta] = test.param;
  return "Share" + std::to_string(std::lround(share * 1e6)) + "ppm_Beta" +
         std::to_string(std::lround(beta * 100)) + "pct";
}

class ReliefAtHeight : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(ReliefAtHeight, IsTheHeightAsked) {
  static const ReliefModel model = model_of(figure());
  const auto [share, beta] = GetParam();
  const double height = share * model.surface().diagonal;
  const auto relief = model.make_at_height(height, {{1, beta}, .04}, 1);
  ASSERT_TRUE(relief) << relief.error().message();
  EXPECT_NEAR(relief->height / height, 1, 1e-3);
  const auto [lowest, highest] = std::minmax_element(relief->heights.begin(), relief->heights.end());
  EXPECT_DOUBLE_EQ(relief->height, std::max(*highest, 0.0) - std::min(*lowest, 0.0));
}

INSTANTIATE_TEST_SUITE_P(Grid, ReliefAtHeight,
                         testing::Combine(testing::Values(.09, .05, .025, .0125, 1e-6),
                                          testing::Values(0, .01, 1, 5, 50, 100)),
                         share_and_beta);

// A sphere has no depth jumps, whose steps would take what is missing.
TEST(Relief, TellsTheLargestHeightThatCanBeReached) {
  const ReliefModel model = model_of(test::sphere(30000, 1));
  const double most = model.make({keep_all, .04}).height;
  EXPECT_TRUE(model.make_at_height(most, {{}, .04}, 1));
  const auto relief = model.make_at_height(1.01 * most, {{}, .04}, 10);
  ASSERT_FALSE(relief);
  EXPECT_EQ(relief.error().kind, ErrorKind::geometry);
  EXPECT_NE(relief.error().message().find("at most"), std::string::npos);
}

// At a high saturation most of the height comes at a u that double cannot hold.
TEST(Relief, HasEveryHeightUpToTheLargest) {
  const ReliefModel model = model_of(figure());
  for (const double beta : {0.0, 10.0, 100.0}) {
    const double most = model.make({{keep_all.u, beta}, .04}).height;
    for (const double share : {.5, .9, .99, .999, .99999}) {
      const auto relief = model.make_at_height(share * most, {{1, beta}, .04}, 1);
      ASSERT_TRUE(relief) << beta << ' ' << share << relief.error().message();
      EXPECT_NEAR(relief->height / (share * most), 1, 2e-5) << beta << ' ' << share;
    }
  }
}

// A few points that float before and beside the figure must not make its system singular.
TEST(Relief, OfAFigureWithFloatingFragmentsExists) {
  Cloud cloud = figure();
  test::Random random(3);
  for (const Vec3& place : {Vec3(2.5, 0, 1), Vec3(0, 2.6, -3), Vec3(0, 0, 4)})
    for (int i = 0; i < 12; ++i)
      test::add(cloud, place + .03 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0), {0, 0, 1});
  const ReliefModel model = model_of(cloud);
  const Relief relief = model.make_at_height(.1, {}, 1).value();
  for (const double z : relief.heights) ASSERT_TRUE(std::isfinite(z));
  EXPECT_EQ(relief.height, .1);
}

TEST(Relief, OfTheSubspaceIsCloseAndAsHighAsAsked) {
  const Surface surface = find_surface(figure(), {}).value();
  const auto relief = [&](Mode mode) {
    return ReliefModel::prepare(surface, nullptr, mode)->make_at_height(.2, {{1, .01}, .04}, 1).value();
  };
  const Relief exact = relief(Mode::exact), close = relief(Mode::subspace);
  EXPECT_EQ(exact.heights, relief(Mode::automatic).heights);
  EXPECT_EQ(close.height, .2);
  double sum = 0;
  for (std::size_t i = 0; i < exact.heights.size(); ++i)
    sum += (exact.heights[i] - close.heights[i]) * (exact.heights[i] - close.heights[i]);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(exact.heights.size())), .02 * exact.height);
}

class LayeredReliefAtHeight : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(LayeredReliefAtHeight, IsTheHeightAsked) {
  static const ReliefModel model = model_of(figure());
  const auto [share, beta] = GetParam();
  Shape shape{{1, beta}, .04};
  shape.style = Style::layered;
  const double height = share * model.surface().diagonal;
  const auto relief = model.make_at_height(height, shape, 1);
  ASSERT_TRUE(relief) << relief.error().message();
  const auto [lowest, highest] = std::minmax_element(relief->heights.begin(), relief->heights.end());
  EXPECT_NEAR((std::max(*highest, 0.0) - std::min(*lowest, 0.0)) / height, 1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Grid, LayeredReliefAtHeight,
                         testing::Combine(testing::Values(.09, .05, .025, .0125, 1e-6),
                                          testing::Values(0, .01, 1)),
                         share_and_beta);

TEST(Relief, OfTwoSheetsLosesTheJumpBetweenThem) {
  for (const double distance : {.2, 1.0, 30.0}) {
    const Cloud both = test::joined(test::sheet(40000, 1, 0), test::sheet(10000, .5, distance, 9));
    const Relief relief = model_of(both).make({keep_all, 0});
    EXPECT_LT(relief.height, 1e-9) << distance;
  }
}

TEST(Relief, ScalesWithTheCloud) {
  Cloud cloud = figure();
  const ReliefModel model = model_of(cloud);
  for (Vec3& p : cloud.points) p *= 4;
  const ReliefModel scaled = model_of(cloud);
  const Shape shape{{1, .01}, .02};
  EXPECT_LT(largest_difference(model, model.make(shape), scaled, scaled.make(shape), 4), 1e-9);
}

TEST(Relief, DoesNotChangeWithTheOrderOfThePoints) {
  Cloud cloud = figure();
  const ReliefModel model = model_of(cloud);
  std::reverse(cloud.points.begin(), cloud.points.end());
  std::reverse(cloud.normals.begin(), cloud.normals.end());
  const ReliefModel reversed = model_of(cloud);
  const Shape shape{{1, .01}, .02};
  EXPECT_EQ(model.make(shape).heights, reversed.make(shape).heights);
}

// A step that binary fractions hold exactly, so that rounding cannot change which points are visible.
TEST(Relief, DoesNotChangeWithTheOrigin) {
  Cloud cloud = figure();
  for (Vec3& p : cloud.points) p = (p * 0x1p20).array().round() * 0x1p-20;
  const ReliefModel model = model_of(cloud);
  for (Vec3& p : cloud.points) p += Vec3(1 << 20, -(1 << 21), 1 << 20);
  const ReliefModel moved = model_of(cloud);
  const Shape shape{{1, .01}, .02};
  EXPECT_EQ(model.make(shape).heights, moved.make(shape).heights);
}

TEST(Relief, TurnsWithTheCloud) {
  const Cloud cloud = figure();
  View quarter;
  quarter.R_view_model << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const ReliefModel model = model_of(cloud), turned = model_of(cloud, quarter);
  EXPECT_NEAR(static_cast<double>(turned.surface().points.size()),
              static_cast<double>(model.surface().points.size()),
              .001 * static_cast<double>(model.surface().points.size()));
  const Shape shape{{1, 0}, 0};
  EXPECT_NEAR(model.make(shape).height / turned.make(shape).height, 1, .02);
}

TEST(Relief, HasTheSameBitsForAnyNumberOfThreads) {
  const Cloud cloud = figure();
  const auto heights = [&](int threads) {
    set_thread_count(threads);
    return model_of(cloud).make({{1, .01}, .02}).heights;
  };
  const std::vector<double> one = heights(1);
  EXPECT_EQ(one, heights(2));
  EXPECT_EQ(one, heights(4));
  set_thread_count(0);
}

}  // namespace
}  // namespace relievo
