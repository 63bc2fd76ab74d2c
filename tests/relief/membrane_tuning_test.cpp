#include "grip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/extent.h"
#include "relievo/core/parallel.h"
#include "relievo/quality/measures.h"
#include "relievo/relief/baselines.h"
#include "relievo/samples/sample.h"
#include "support/shapes.h"

namespace relievo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Cloud figure() {
  return make_sample("shell", {60000}).value();
}

ReliefModel model_of(const Cloud& cloud, Mode mode = Mode::exact) {
  return ReliefModel::prepare(find_surface(cloud, {}).value(), nullptr, mode).value();
}

const ReliefModel& model() {
  static const ReliefModel it = model_of(figure());
  return it;
}

Relief relief_of(const ReliefModel& model, double height, std::optional<Hold> hold = {}) {
  Shape shape = layered_shape();
  shape.hold = hold;
  return model.make_at_height(height, shape, 1).value();
}

void expect_to_keep_what_compression_keeps(const ReliefModel& m) {
  const Judge judge(m.surface());
  for (const double share : {.0125, .025, .05}) {
    const double height = share * longer_side_of(m.surface().points);
    const Measures ours = judge.measure(relief_of(m, height).heights);
    const Measures rival = judge.measure(gradient_relief(m, height).heights);
    EXPECT_GT(ours.detail[2], rival.detail[2] - .001) << share;
    EXPECT_GT(ours.order, rival.order) << share;
    EXPECT_GT(ours.shading, rival.shading) << share;
  }
}

// What it is for, by the full measures.
TEST(Grip, KeepsDetailAndOrderOfGradientDomainCompression) {
  EXPECT_GT(model().hold_at(.25).reach, .199);
  expect_to_keep_what_compression_keeps(model());
}

TEST(Grip, HoldsLooselyAndPullsHardWhereOrderNeedsIt) {
  const ReliefModel mask = model_of(make_sample("green_man", {60000}).value());
  EXPECT_GT(mask.hold_at(.25).share, .78);
  EXPECT_LT(mask.hold_at(1).reach, .06);
  expect_to_keep_what_compression_keeps(mask);
}

// One a fifth tighter loses detail or order.
TEST(Grip, HoldsAsTightlyAsItMay) {
  const Judge judge(model().surface());
  for (const double share : {.0125, .025}) {
    const double height = share * longer_side_of(model().surface().points);
    const Relief relief = relief_of(model(), height);
    const Hold hold = *relief.shape.hold, tighter{.8 * hold.share, hold.reach};
    const Measures held = judge.measure(relief.heights),
                   more = judge.measure(relief_of(model(), height, tighter).heights),
                   rival = judge.measure(gradient_relief(model(), height).heights);
    EXPECT_TRUE(more.detail[2] < rival.detail[2] + .0004 || more.order < rival.order + .002) << share;
    EXPECT_LT(more.detail[2], held.detail[2]);
  }
}

TEST(Grip, HeightsGrowWithU) {
  EXPECT_EQ(model().hold_at(infinity).share, 1);
  const auto span = [&](double u) {
    Shape shape = layered_shape();
    shape.compression.u = u;
    return model().make(shape).height;
  };
  double last = 0;
  for (double u = .05; u < 10; u *= 1.3) {
    const Hold hold = model().hold_at(u);
    EXPECT_GT(hold.share, .2);
    EXPECT_LE(hold.share, 1);
    EXPECT_GE(hold.reach, .0349);
    EXPECT_LE(hold.reach, .2001);
    EXPECT_GT(span(u), last) << u;
    last = span(u);
  }
}

// At the u that holds are found for, too.
TEST(Grip, IsContinuous) {
  EXPECT_NEAR(model().hold_at(0).share, model().hold_at(1e-9).share, 1e-8);
  for (const double u : {.25, .625, 1.5625, 3.90625}) {
    const Hold before = model().hold_at(u * (1 - 1e-9)), after = model().hold_at(u * (1 + 1e-9));
    EXPECT_NEAR(before.share, after.share, 1e-7) << u;
    EXPECT_NEAR(before.reach, after.reach, 1e-7) << u;
  }
}

TEST(Grip, GivesWayToTheShapesHold) {
  const Hold hold{.6, .1};
  const Relief relief = relief_of(model(), .05, hold);
  EXPECT_EQ(relief.shape.hold, hold);
  EXPECT_NE(relief.heights, relief_of(model(), .05).heights);
  const Relief own = relief_of(model(), .05);
  const std::vector<double> again = relief_of(model(), .05, own.shape.hold).heights;
  for (std::size_t i = 0; i < again.size(); ++i) ASSERT_NEAR(again[i], own.heights[i], 1e-3 * own.height);
}

TEST(Grip, IsNotForThePapersStyle) {
  EXPECT_FALSE(model().make({{1, .01}, .02}).shape.hold);
}

TEST(Grip, DoesNotDependOnScale) {
  Cloud cloud = figure();
  for (Vec3& p : cloud.points) p *= 1024;
  const ReliefModel large = model_of(cloud);
  for (const double u : {.3, 1.0, 3.0}) {
    EXPECT_NEAR(large.hold_at(u).share, model().hold_at(u).share, 1e-3);
    EXPECT_NEAR(large.hold_at(u).reach, model().hold_at(u).reach, 1e-3);
  }
}

TEST(Grip, IsTheSameInTheSubspace) {
  const ReliefModel subspace = model_of(figure(), Mode::subspace);
  for (const double u : {.3, 1.0, 3.0}) EXPECT_EQ(subspace.hold_at(u), model().hold_at(u)) << u;
}

// On a dome nothing that holds broad forms back keeps the order.
TEST(Grip, ComesNearestWhereItCannotKeepAll) {
  const auto dome = [](double x, double y) {
    return .8 - .4 * (x * x + y * y) + .06 * std::sin(14 * x) * std::sin(11 * y);
  };
  const ReliefModel m = model_of(test::height_field(60000, 1, dome, [&](double x, double y) -> Vec2 {
    constexpr double d = 1e-5;
    return Vec2(dome(x + d, y) - dome(x - d, y), dome(x, y + d) - dome(x, y - d)) / (2 * d);
  }));
  const Judge judge(m.surface());
  const Relief relief = relief_of(m, .05);
  const Measures ours = judge.measure(relief.heights), rival = judge.measure(gradient_relief(m, .05).heights);
  ASSERT_LT(ours.order, rival.order - .02);
  EXPECT_GT(ours.detail[2], rival.detail[2] - .001);
  const Hold own = *relief.shape.hold;
  for (const Hold& hold :
       {Hold{.4, .08}, {.7, .2}, {.7, .05}, {.85 * own.share, own.reach}, {own.share, .7 * own.reach}}) {
    const Measures other = judge.measure(relief_of(m, .05, hold).heights);
    EXPECT_TRUE(other.order < ours.order + .01 || other.detail[2] < rival.detail[2] + .001) << hold.share;
  }
}

TEST(Grip, CanBeCancelled) {
  for (const Mode mode : {Mode::exact, Mode::subspace}) {
    Progress* self = nullptr;
    Progress progress([&](std::string_view stage, double) {
      if (stage == "hold") self->cancel();
    });
    self = &progress;
    const auto m = ReliefModel::prepare(find_surface(figure(), {}).value(), &progress, mode);
    ASSERT_FALSE(m);
    EXPECT_EQ(m.error().kind, ErrorKind::cancelled);
  }
}

// Too narrow, too few points, level: no errors.
TEST(Grip, IsTheUsualWhereNothingCanBeMeasured) {
  Cloud strip = test::sheet(3000, 1, 0);
  for (Vec3& p : strip.points) p.x() *= .005;
  for (const Cloud& cloud : {strip, test::sheet(3000, 1, 0), test::sheet(60000, 1, 0)})
    EXPECT_NEAR(model_of(cloud).hold_at(.25).share, 1 - .5 * std::exp(-.25 * .25), 1e-12);
}

TEST(Grip, HasTheSameBitsForAnyNumberOfThreads) {
  const auto holds = [](int threads) {
    set_thread_count(threads);
    const ReliefModel m = model_of(test::torus(60000, 1, .4));
    std::vector<Hold> all;
    for (const double u : {.1, .4, 1.0, 5.0}) all.push_back(m.hold_at(u));
    return all;
  };
  const std::vector<Hold> one = holds(1);
  EXPECT_EQ(one, holds(3));
  set_thread_count(0);
}

}  // namespace
}  // namespace relievo
