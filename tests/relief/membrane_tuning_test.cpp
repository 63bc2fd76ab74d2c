#include "relief/membrane/membrane_tuning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "relievo/quality/measures.h"
#include "relievo/relief/baselines.h"
#include "relievo/relief/frame.h"
#include "relievo/relief/relief.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/curvature.h"
#include "relievo/scan/spacing.h"
#include "support/same_bits.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Cloud figure() {
  return make_sample("shell", {60000}).value();
}

const ReliefModel& model() {
  static const ReliefModel it = test::prepared(figure());
  return it;
}

Relief relief_of(const ReliefModel& model, double height, std::optional<MembraneParams> membrane = {}) {
  Shape shape = layered_shape();
  shape.membrane = membrane;
  return model.make_at_height(height, shape, 1).value();
}

void expect_to_keep_what_compression_keeps(const ReliefModel& m) {
  const ReliefMetrics metrics(m.surface());
  for (const double share : {.0125, .025, .05}) {
    const double height = share * m.surface().longer_side();
    const Measures ours = metrics.measure(relief_of(m, height).heights);
    const Measures baseline = metrics.measure(gradient_relief(m, height).heights);
    EXPECT_GT(ours.detail[2], baseline.detail[2] - .001) << share;
    EXPECT_GT(ours.order, baseline.order) << share;
    EXPECT_GT(ours.shading, baseline.shading) << share;
  }
}

// The tuning uses estimates of detail and order. By the full metrics, too, both must be kept.
TEST(MembraneTuning, KeepsDetailAndOrderOfGradientDomainCompression) {
  expect_to_keep_what_compression_keeps(model());
}

// To keep the order of its depths, the green man needs weak compression and a strong pull; the shell does
// not.
TEST(MembraneTuning, CompressesWeaklyAndPullsHardWhereOrderNeedsIt) {
  const ReliefModel mask = test::prepared(make_sample("green_man", {60000}).value());
  EXPECT_GT(mask.membrane_at(.25).height_share, 1.1 * model().membrane_at(.25).height_share);
  EXPECT_LT(mask.membrane_at(1).pull_length, .5 * model().membrane_at(1).pull_length);
  expect_to_keep_what_compression_keeps(mask);
  const double height = .0125 * mask.surface().longer_side();
  const MembraneParams like_the_shell = model().membrane_at(relief_of(mask, height).shape.compression.u);
  const ReliefMetrics metrics(mask.surface());
  EXPECT_LT(metrics.measure(relief_of(mask, height, like_the_shell).heights).order,
            metrics.measure(gradient_relief(mask, height).heights).order);
}

// Returns the curvatures of a surface through the points, less their mean.
Eigen::ArrayXd varying_curvature(const Cloud& cloud) {
  std::vector<Index> all(cloud.size());
  std::iota(all.begin(), all.end(), Index{0});
  const std::vector<double> k = mean_curvature(cloud, measure_spacing(cloud), all);
  const Eigen::Map<const Eigen::ArrayXd> values(k.data(), std::ssize(k));
  return values - values.mean();
}

// Returns the correlation of the curvatures of the relief and of the model.
double kept_curvature(const Surface& surface, const std::vector<double>& heights) {
  Cloud model{surface.points, surface.normals}, relief = model;
  for (std::size_t i = 0; i < heights.size(); ++i) relief.points[i].z() = heights[i];
  relief.normals = vertex_normals(surface, std::vector<float>(heights.begin(), heights.end()));
  const Eigen::ArrayXd a = varying_curvature(model), b = varying_curvature(relief);
  return (a * b).sum() / std::sqrt((a * a).sum() * (b * b).sum());
}

// Returns the share of random pairs of points, at most `reach` apart, of which the nearer one is the
// higher one.
double kept_order(const Surface& surface, const std::vector<double>& heights, double reach = infinity) {
  constexpr double pairs = 20000;
  const double least_depth = .002 * surface.longer_side(), points = static_cast<double>(heights.size());
  test::Random random(11);
  double kept = 0;
  for (int found = 0; found < pairs;) {
    const auto i = static_cast<std::size_t>(random.uniform(0, points)),
               j = static_cast<std::size_t>(random.uniform(0, points));
    const Vec3 step = surface.points[j] - surface.points[i];
    if (step.head<2>().norm() > reach || std::abs(step.z()) < least_depth) continue;
    kept += (heights[j] > heights[i]) == (step.z() > 0);
    ++found;
  }
  return kept / pairs;
}

// These measures are not those of the tuning: they take points instead of pixels. The order of all pairs
// of points is better than that of gradient-domain compression; that of close pairs and the curvature are
// nearly as good.
TEST(MembraneTuning, KeepsOrderAndCurvatureByOtherMeasures) {
  const Surface& surface = model().surface();
  const double side = surface.longer_side(), close = .06 * side;
  for (const double share : {.0125, .025, .05}) {
    const std::vector<double> ours = relief_of(model(), share * side).heights,
                              baseline = gradient_relief(model(), share * side).heights;
    EXPECT_GT(kept_order(surface, ours), kept_order(surface, baseline) + .02) << share;
    EXPECT_GT(kept_order(surface, ours, close), kept_order(surface, baseline, close) - .01) << share;
    EXPECT_GT(kept_curvature(surface, ours), kept_curvature(surface, baseline) - .05) << share;
  }
}

// With a height share that is a fifth smaller, detail or order would be no better than with gradient-domain
// compression, up to a small margin.
TEST(MembraneTuning, CompressesAsStronglyAsPossible) {
  const ReliefMetrics metrics(model().surface());
  for (const double share : {.0125, .025}) {
    const double height = share * model().surface().longer_side();
    const Relief relief = relief_of(model(), height);
    const MembraneParams params = *relief.shape.membrane,
                         stronger{.8 * params.height_share, params.pull_length};
    const Measures tuned = metrics.measure(relief.heights),
                   more = metrics.measure(relief_of(model(), height, stronger).heights),
                   baseline = metrics.measure(gradient_relief(model(), height).heights);
    EXPECT_TRUE(more.detail[2] < baseline.detail[2] + .0004 || more.order < baseline.order + .002) << share;
    EXPECT_LT(more.detail[2], tuned.detail[2]);
  }
}

TEST(MembraneTuning, HeightsGrowWithU) {
  EXPECT_EQ(model().membrane_at(infinity).height_share, 1);
  const auto span = [&](double u) {
    Shape shape = layered_shape();
    shape.compression.u = u;
    return model().make(shape).height;
  };
  double last = 0;
  for (double u = .05; u < 10; u *= 1.3) {
    const MembraneParams params = model().membrane_at(u);
    EXPECT_GT(params.height_share, .2);
    EXPECT_LE(params.height_share, 1);
    EXPECT_GE(params.pull_length, .0349);
    EXPECT_LE(params.pull_length, .2001);
    EXPECT_GT(span(u), last) << u;
    last = span(u);
  }
}

// The parameters are continuous at the knots, too.
TEST(MembraneTuning, IsContinuous) {
  EXPECT_NEAR(model().membrane_at(0).height_share, model().membrane_at(1e-9).height_share, 1e-8);
  for (const double u : {.25, .625, 1.5625, 3.90625}) {
    const MembraneParams before = model().membrane_at(u * (1 - 1e-9)),
                         after = model().membrane_at(u * (1 + 1e-9));
    EXPECT_NEAR(before.height_share, after.height_share, 1e-7) << u;
    EXPECT_NEAR(before.pull_length, after.pull_length, 1e-7) << u;
  }
}

TEST(MembraneTuning, GivesWayToTheShapesMembrane) {
  const MembraneParams params{.6, .1};
  const Relief relief = relief_of(model(), .05, params);
  EXPECT_EQ(relief.shape.membrane, params);
  EXPECT_NE(relief.heights, relief_of(model(), .05).heights);
  const Relief own = relief_of(model(), .05);
  const std::vector<double> again = relief_of(model(), .05, own.shape.membrane).heights;
  for (std::size_t i = 0; i < again.size(); ++i) ASSERT_NEAR(again[i], own.heights[i], 1e-3 * own.height);
}

TEST(MembraneTuning, IsNotForThePapersStyle) {
  EXPECT_FALSE(model().make({{1, .01}, .02}).shape.membrane);
}

TEST(MembraneTuning, DoesNotDependOnScale) {
  Cloud cloud = figure();
  for (Vec3& p : cloud.points) p *= 1024;
  const ReliefModel large = test::prepared(cloud);
  for (const double u : {.3, 1.0, 3.0}) {
    EXPECT_NEAR(large.membrane_at(u).height_share, model().membrane_at(u).height_share, 1e-3);
    EXPECT_NEAR(large.membrane_at(u).pull_length, model().membrane_at(u).pull_length, 1e-3);
  }
}

TEST(MembraneTuning, IsTheSameInTheSubspace) {
  const ReliefModel subspace = test::prepared(figure(), Mode::subspace);
  for (const double u : {.3, 1.0, 3.0}) EXPECT_EQ(subspace.membrane_at(u), model().membrane_at(u)) << u;
}

// On a dome, no parameters that attenuate broad forms keep the order of depths. The tuning must find those
// that come nearest.
TEST(MembraneTuning, ComesNearestWhereItCannotKeepAll) {
  const auto dome = [](double x, double y) {
    return .8 - .4 * (x * x + y * y) + .06 * std::sin(14 * x) * std::sin(11 * y);
  };
  const ReliefModel m = test::prepared(test::height_field(60000, 1, dome, [&](double x, double y) -> Vec2 {
    constexpr double d = 1e-5;
    return Vec2(dome(x + d, y) - dome(x - d, y), dome(x, y + d) - dome(x, y - d)) / (2 * d);
  }));
  const ReliefMetrics metrics(m.surface());
  const Relief relief = relief_of(m, .05);
  const Measures ours = metrics.measure(relief.heights),
                 baseline = metrics.measure(gradient_relief(m, .05).heights);
  ASSERT_LT(ours.order, baseline.order - .02);
  EXPECT_GT(ours.detail[2], baseline.detail[2] - .001);
  const MembraneParams own = *relief.shape.membrane;
  for (const MembraneParams& params : {MembraneParams{.4, .08},
                                       {.7, .2},
                                       {.7, .05},
                                       {.85 * own.height_share, own.pull_length},
                                       {own.height_share, .7 * own.pull_length}}) {
    const Measures other = metrics.measure(relief_of(m, .05, params).heights);
    EXPECT_TRUE(other.order < ours.order + .01 || other.detail[2] < baseline.detail[2] + .001)
        << params.height_share;
  }
}

TEST(MembraneTuning, CanBeCancelled) {
  for (const Mode mode : {Mode::exact, Mode::subspace}) {
    Progress* self = nullptr;
    Progress progress([&](std::string_view stage, double) {
      if (stage == "tuning") self->cancel();
    });
    self = &progress;
    expect_error(ReliefModel::prepare(find_surface(figure(), {}).value(), &progress, {mode}),
                 ErrorKind::cancelled);
  }
}

// Nothing can be measured on a strip that is too narrow, on a sheet with too few points, or on a level sheet.
// The tuning then keeps its default without an error.
TEST(MembraneTuning, HasItsDefaultWhereNothingCanBeMeasured) {
  Cloud strip = test::sheet(3000, 1, 0);
  for (Vec3& p : strip.points) p.x() *= .005;
  const MembraneTuning initial;
  for (const Cloud& cloud : {strip, test::sheet(3000, 1, 0), test::sheet(60000, 1, 0)}) {
    const ReliefModel m = test::prepared(cloud);
    for (const double u : {0.0, .25, 1.0, 10.0}) EXPECT_EQ(m.membrane_at(u), initial.at(u)) << u;
  }
  EXPECT_NE(model().membrane_at(.25), initial.at(.25));
  double last = 0;
  for (const double u : {.25, 1.0, 3.0, 10.0}) {
    EXPECT_GT(initial.at(u).height_share, last);
    EXPECT_LT(initial.at(u).height_share, 1);
    last = initial.at(u).height_share;
  }
}

TEST(MembraneTuning, HasTheSameBitsForAnyNumberOfThreads) {
  test::expect_same_for_any_threads([] {
    const ReliefModel m = test::prepared(test::torus(60000, 1, .4));
    std::vector<MembraneParams> all;
    for (const double u : {.1, .4, 1.0, 5.0}) all.push_back(m.membrane_at(u));
    return all;
  });
}

}  // namespace
}  // namespace relievo
