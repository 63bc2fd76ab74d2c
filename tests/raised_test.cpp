#include "raised.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "relievo/frame.h"
#include "relievo/measures.h"
#include "relievo/method.h"
#include "relievo/parallel.h"
#include "shapes.h"

namespace relievo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

ReliefModel model_of(const Cloud& cloud, Mode mode = Mode::exact) {
  return ReliefModel::prepare(find_surface(cloud, {}).value(), nullptr, mode).value();
}

Cloud figure() {
  return test::joined(
      test::height_field(
          20000, 1.2, [](double x, double y) { return .2 * std::sin(5 * x) * std::cos(4 * y) - 1; },
          [](double x, double y) {
            return Vec2(std::cos(5 * x) * std::cos(4 * y), -.8 * std::sin(5 * x) * std::sin(4 * y));
          }),
      test::torus(20000, 1.5, .4));
}

const ReliefModel& model() {
  static const ReliefModel made = model_of(figure());
  return made;
}

Shape raised(double u, double beta = 0) {
  Shape shape = default_shape(Method::raised);
  shape.compression = {u, beta};
  return shape;
}

Cloud two_sheets() {
  return test::joined(test::sheet(20000, 1, 0), test::sheet(5000, .5, 3, 9));
}

TEST(RaisedLayers, FadeTowardsTheSilhouetteAlone) {
  const Surface& surface = model().surface();
  const RaisedLayers& layers = model().raised_layers();
  const double width = .008 * 2 * (1.5 + .4);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const auto t = static_cast<double>(surface.boundary.distance[i]) / width;
    const double s = std::min(t, 1.0);
    ASSERT_NEAR(layers.fade[i], s * s * (3 - 2 * s), .01);
  }
}

TEST(RaisedLayers, AreMadeOnceAndCounted) {
  const ReliefModel fresh = model_of(test::torus(5000, 1, .4));
  const std::size_t before = fresh.memory();
  fresh.make({{.5, 0}, .04});
  EXPECT_EQ(fresh.memory(), before);
  const RaisedLayers* layers = &fresh.raised_layers();
  fresh.make(raised(.5));
  EXPECT_EQ(layers, &fresh.raised_layers());
  EXPECT_EQ(fresh.memory(), before + layers->memory());
}

// However little of the layers is kept, what is left to the ordinary system then is of third order.
TEST(RaisedWeights, LeaveNothingOfGentleSlopes) {
  PointLayers layers;
  layers.fine = {.3F, .1F}, layers.middle = {0, .2F}, layers.coarse = {-.1F, .4F};
  const RaisedWeights weights = RaisedWeights::of(raised(1e-3), 1);
  EXPECT_LT(weights.rest(layers, 1.0, .7, 4.0).norm(), 1e-8);
  EXPECT_EQ(weights.kept.depth, 0);
  EXPECT_GT(weights.linear.depth, 0);
}

TEST(RaisedWeights, WithTheirHeightsAreTheWholeSlope) {
  PointLayers layers;
  layers.fine = {.3F, .1F}, layers.middle = {0, .2F}, layers.coarse = {-.1F, .4F};
  const RaisedWeights weights = RaisedWeights::of(raised(infinity), .8);
  const Vec2 linear = (.8F * .7F * (layers.fine + layers.middle + layers.coarse)).cast<double>();
  const Vec2 whole = weights.rest(layers, 1.2, .7, 100.0) + linear, sine = 1.2 * .7 * Vec2(.2, .7);
  EXPECT_LT((whole - sine / std::sqrt(1 - sine.squaredNorm())).norm(), 1e-6);
}

TEST(MeanShare, IsThatOfThePoints) {
  const std::vector<float> k{0, .1F, -.5F, 1};
  EXPECT_EQ(mean_share({.3, 0}, k, SaturationShare(1, {.3, 0})), 1);
  const Compression saturated{.3, 2};
  const double e = 1 - std::exp(-1);
  EXPECT_NEAR(mean_share(saturated, k, SaturationShare(1, saturated)),
              (-std::expm1(-.01) - std::expm1(-.25) + e) / e / 4, 1e-6);
}

TEST(Raised, OfAPlaneIsFlat) {
  EXPECT_NEAR(model_of(test::sheet(3000, 1, 2)).make(raised(infinity)).height, 0, 1e-9);
}

// Kept in full, a wave much shorter than the pull's reach is itself: by regression, away from the rim.
TEST(Raised, OfAWaveKeptInFullIsTheWave) {
  const double k = 2 * std::numbers::pi / .15, a = .3 / k;
  const ReliefModel wave = model_of(test::height_field(
      30000, 1, [=](double x, double) { return a * std::sin(k * x); },
      [=](double x, double) { return Vec2(a * k * std::cos(k * x), 0); }));
  Shape shape = raised(infinity);
  shape.max_slope = 100;
  const Relief relief = wave.make(shape);
  double product = 0, square = 0;
  for (std::size_t i = 0; i < relief.heights.size(); ++i) {
    const Vec3& p = wave.surface().points[i];
    if (p.head<2>().cwiseAbs().maxCoeff() > .75) continue;
    product += p.z() * relief.heights[i], square += p.z() * p.z();
  }
  EXPECT_NEAR(product / square, 1, .05);
}

TEST(Raised, StandsOnTheBaseAndOffItAtTheSilhouette) {
  const Relief relief = model().make(raised(.5));
  const Surface& surface = model().surface();
  double lowest = infinity;
  for (std::size_t i = 0; i < relief.heights.size(); ++i) {
    if (surface.boundary.is_boundary[i]) {
      ASSERT_EQ(relief.heights[i], 0);
    } else {
      lowest = std::min(lowest, relief.heights[i]);
    }
  }
  EXPECT_NEAR(lowest, 0, 1e-12);
  const Judge judge(surface);
  const Shape ours = default_shape(Method::ours);
  EXPECT_GT(judge.measure(relief.heights).rim_step, .4);
  EXPECT_LT(judge.measure(model().make(ours).heights).rim_step, .2);
}

TEST(Raised, RimIsBevelledAsWideAsAsked) {
  Shape narrow = raised(.5), wide = narrow;
  narrow.boundary_width = .5, wide.boundary_width = 4;
  const Judge judge(model().surface());
  EXPECT_LT(judge.measure(model().make(wide).heights).rim_step,
            .7 * judge.measure(model().make(narrow).heights).rim_step);
}

// Ranks rise over a fifth of the longer side, normals say nothing: a slope, and no step.
TEST(Raised, OfTwoSheetsHasNoStepBetweenThem) {
  const ReliefModel sheets = model_of(two_sheets());
  const Relief relief = sheets.make(raised(infinity));
  const Measures m = Judge(sheets.surface()).measure(relief.heights);
  EXPECT_LT(m.jump_step, .2);
  EXPECT_GT(m.order, .9);
}

// At tiny heights tan is sin and all is linear.
TEST(Raised, IsLinearInSmallWeights) {
  const Relief small = model().make(raised(1e-4)), smaller = model().make(raised(5e-5));
  EXPECT_NEAR(small.height / smaller.height, 2, 1e-3);
  for (std::size_t i = 0; i < small.heights.size(); ++i)
    ASSERT_NEAR(small.heights[i], 2 * smaller.heights[i], 2e-3 * small.height);
}

class RaisedAtHeight : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(RaisedAtHeight, IsTheHeightAsked) {
  const auto [share, beta] = GetParam();
  const double height = share * model().surface().diagonal;
  const auto relief = model().make_at_height(height, raised(1, beta), 1);
  ASSERT_TRUE(relief) << relief.error().message();
  EXPECT_NEAR(*std::ranges::max_element(relief->heights) / height, 1, 1e-9);
  EXPECT_GE(*std::ranges::min_element(relief->heights), -1e-9 * height);
}

INSTANTIATE_TEST_SUITE_P(Grid, RaisedAtHeight,
                         testing::Combine(testing::Values(.05, .0125, 1e-6), testing::Values(0, .01, 1)));

double largest_difference(const Frame& frame, const Relief& relief) {
  double worst = 0;
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(frame.heights[i]) - relief.heights[i]));
  return worst / relief.height;
}

TEST(Raised, FramesAgreeWithTheExactRelief) {
  FrameMaker maker(model());
  Frame frame;
  FrameOptions options;
  for (const double beta : {0.0, 1.0})
    for (const double u : {.3, 2.0}) {
      options.shape = raised(u, beta);
      maker.make(options, frame);
      EXPECT_LT(largest_difference(frame, model().make(options.shape)), 1e-4) << u << ' ' << beta;
    }
}

TEST(Raised, FramesKeepALockedHeight) {
  FrameMaker maker(model());
  Frame frame;
  FrameOptions options;
  for (const double share : {.05, .0125, .06}) {
    options.height = share * model().surface().diagonal;
    for (const double gamma : {0.0, .02, .04, .08}) {
      options.shape = raised(1);
      options.shape.gamma = gamma;
      maker.make(options, frame);
      ASSERT_TRUE(frame.is_height_met) << share << ' ' << gamma;
      ASSERT_NEAR(frame.height / *options.height, 1, 1e-3) << share << ' ' << gamma;
    }
  }
}

// The layers' heights are exact there; only what they leave goes by way of the control points.
TEST(Raised, OfASubspaceIsClose) {
  const ReliefModel subspace = model_of(figure(), Mode::subspace);
  const Relief close = subspace.make(raised(.5)), exact = model().make(raised(.5));
  double sum_sq = 0;
  for (std::size_t i = 0; i < exact.heights.size(); ++i)
    sum_sq += (exact.heights[i] - close.heights[i]) * (exact.heights[i] - close.heights[i]);
  EXPECT_LT(std::sqrt(sum_sq / static_cast<double>(exact.heights.size())), .01 * exact.height);
  FrameMaker maker(subspace);
  Frame frame;
  FrameOptions options;
  options.shape = raised(.5);
  maker.make(options, frame);
  EXPECT_LT(largest_difference(frame, close), 1e-4);
}

TEST(Raised, HasTheSameBitsForAnyNumberOfThreads) {
  const Cloud cloud = test::torus(20000, 1, .4);
  const auto heights = [&](int threads) {
    set_thread_count(threads);
    return model_of(cloud).make(raised(.4, 1)).heights;
  };
  const std::vector<double> one = heights(1);
  EXPECT_EQ(one, heights(3));
  set_thread_count(0);
}

TEST(HeightTails, WithoutABaseRoundBothEndsOfWhatCounts) {
  std::vector<double> heights{-50, 1e3};
  std::vector<std::uint8_t> left_out{1, 1};
  for (int i = 0; i <= 100000; ++i) heights.push_back(5 + i * 1e-5), left_out.push_back(0);
  const HeightTails<double> tails(heights,
                                  {.share = .1, .flattest = .5, .keeps_base = false, .left_out = left_out});
  EXPECT_EQ(tails.lowest(), 5);
  EXPECT_EQ(tails(5.5), 5.5);
  // A tail of slope 1 to 0.5 keeps 3/4 of its length.
  EXPECT_NEAR(tails(6), 5.9 + .075, 1e-3);
  EXPECT_NEAR(tails(5), 5.1 - .075, 1e-3);
}

}  // namespace
}  // namespace relievo
