#include "quality/fast_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "relievo/quality/measures.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/surface.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Returns hills with a ring before them, at which the depth jumps.
Surface figure() {
  const Cloud hills = test::height_field(
      60000, 1.2, [](double x, double y) { return .2 * std::sin(5 * x) * std::cos(4 * y) - 1; },
      [](double x, double y) {
        return Vec2(std::cos(5 * x) * std::cos(4 * y), -.8 * std::sin(5 * x) * std::sin(4 * y));
      });
  return find_surface(test::joined(hills, test::torus(60000, .6, .2)), {}).value();
}

// Returns four reliefs: the depths, scaled or distorted in different ways.
std::vector<std::vector<double>> reliefs(const Surface& surface) {
  std::vector<std::vector<double>> all(4);
  for (const Vec3& p : surface.points) {
    all[0].push_back(.05 * p.z());
    all[1].push_back(p.z());
    all[2].push_back(.1 * p.z() + .004 * std::sin(12 * p.x()) * std::cos(9 * p.y()));
    all[3].push_back(.1 * std::tanh(2 * p.z()) - .03 * p.x() * p.x());
  }
  return all;
}

TEST(FastMetrics, EstimatesWhatReliefMetricsMeasures) {
  const Surface surface = find_surface(make_sample("shell", {120000}).value(), {}).value();
  const ReliefMetrics metrics(surface);
  const FastMetrics fast(surface);
  EXPECT_NEAR(static_cast<double>(fast.pixels()), static_cast<double>(metrics.pixels()) / 4,
              .05 * static_cast<double>(fast.pixels()));
  for (const std::vector<double>& heights : reliefs(surface)) {
    const Measures whole = metrics.measure(heights);
    const Image<float> z = fast.draw(heights);
    EXPECT_NEAR(fast.estimate(z).detail, whole.detail[2], .0005 + .08 * (1 - whole.detail[2]));
    EXPECT_NEAR(fast.estimate(z).order, whole.order, .008);
  }
}

TEST(FastMetrics, HasExactScoresOfTheSameBits) {
  const Surface surface = figure();
  const ReliefMetrics metrics(surface);
  const FastMetrics fast(surface);
  for (const std::vector<double>& heights : reliefs(surface)) {
    const Measures whole = metrics.measure(heights);
    EXPECT_EQ(fast.exact_scores(heights).detail, whole.detail[2]);
    EXPECT_EQ(fast.exact_scores(heights).order, whole.order);
  }
}

TEST(FastMetrics, DrawsSmoothHeightsAlike) {
  const Surface surface = figure();
  const FastMetrics fast(surface);
  std::vector<double> heights;
  for (const Vec3& p : surface.points) heights.push_back(.1 * std::sin(3 * p.x()) + .05 * p.y() * p.y());
  const Image<float> a = fast.draw(heights),
                     b = fast.draw_smooth([&](Index i) { return static_cast<float>(heights[i]); });
  ASSERT_EQ(a.size(), b.size());
  // Heights are in pixels. They may differ more at silhouettes, where some of the four pixels that each pixel
  // is made of lie outside.
  std::size_t unlike = 0, inside = 0;
  for (std::size_t i = 0; i < a.size(); ++i) unlike += std::abs(a[i] - b[i]) > .02F, inside += a[i] != 0;
  EXPECT_LT(unlike, inside / 50);
}

TEST(FastMetrics, KnowsALevelReliefShowsNothing) {
  const Surface surface = figure();
  const FastMetrics fast(surface);
  const Image<float> level = fast.draw(std::vector<double>(surface.points.size()));
  EXPECT_EQ(fast.estimate(level).detail, 0);
  EXPECT_EQ(fast.estimate(level).order, 0);
}

TEST(FastMetrics, HasNothingToLookAtOnAThinStrip) {
  Cloud strip = test::sheet(3000, 1, 0);
  for (Vec3& p : strip.points) p.x() *= .005;
  EXPECT_EQ(FastMetrics(find_surface(strip, {}).value()).pixels(), 0U);
}

}  // namespace
}  // namespace relievo
