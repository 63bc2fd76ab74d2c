#include "paper/paper_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paper/surface.h"
#include "relievo/relief/frame.h"
#include "relievo/relief/relief.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

ReliefModel prepared(const Cloud& cloud, Mode mode = Mode::exact) {
  const View view = View().for_paper();
  return value_of(ReliefModel::of_view(*value_of(MeasuredCloud::measure(cloud, view)), view, mode));
}

Cloud ball_before_a_sheet(double distance = 2) {
  return test::joined(test::sheet(24000, 1.5, 0), test::moved(test::sphere(12000, .7), Vec3(0, 0, distance)));
}

// Section 4.1: high discontinuities vanish. Only normals count, so the relief is the same however far the ball is in
// front of the sheet.
TEST(PaperRelief, DoesNotDependOnTheHeightOfDepthJumps) {
  const ReliefModel near = prepared(ball_before_a_sheet(2)), far = prepared(ball_before_a_sheet(20));
  ASSERT_EQ(near.surface().points.size(), far.surface().points.size());
  const Relief low = near.make({{1, .01}, .02}), high = far.make({{1, .01}, .02});
  EXPECT_GT(low.height, .1);
  for (std::size_t i = 0; i < low.heights.size(); ++i)
    EXPECT_NEAR(low.heights[i], high.heights[i], 1e-3 * low.height);
}

TEST(PaperRelief, HasExactlyTheHeightAskedFor) {
  const ReliefModel model = prepared(ball_before_a_sheet());
  for (const bool is_beta_free : {false, true})
    for (const double height : {.05, .2}) {
      Shape shape{{1, .5}, .02};
      shape.is_beta_free = is_beta_free;
      const Relief relief = value_of(model.make_at_height(height, shape, 1));
      const auto [low, high] = std::ranges::minmax(relief.heights);
      EXPECT_NEAR(std::max(high, 0.0) - std::min(low, 0.0), height, 1e-6 * height);
      EXPECT_EQ(relief.shape.compression.beta == .5, !is_beta_free);
    }
  EXPECT_EQ(model.make_at_height(50, Shape{{1, .5}, .02}, 1).error().kind, ErrorKind::geometry);
}

TEST(PaperRelief, IsFlatWithoutWeightAndLiesOnTheBaseAtItsBoundary) {
  const ReliefModel model = prepared(ball_before_a_sheet());
  EXPECT_LT(model.make({{0, 1}, .5}).height, 1e-6);
  const Relief relief = model.make({{1, .01}, .1});
  for (std::size_t i = 0; i < relief.heights.size(); ++i)
    if (model.surface().boundary.is_boundary[i]) {
      EXPECT_EQ(relief.heights[i], 0);
    }
}

// The second equation (9): the difference that gamma makes is gamma k h at each point inside.
TEST(PaperRelief, DetailIsProportionalToCurvature) {
  const ReliefModel model = prepared(ball_before_a_sheet());
  const Relief plain = model.make({{1, .01}, 0}), detailed = model.make({{1, .01}, .1});
  for (std::size_t i = 0; i < plain.heights.size(); ++i)
    if (!model.surface().boundary.is_boundary[i]) {
      EXPECT_NEAR(detailed.heights[i] - plain.heights[i],
                  .1 * static_cast<double>(model.surface().curvature.k[i]) * plain.height, 1e-5);
    }
}

TEST(PaperRelief, OfControlPointsIsCloseToTheExactOne) {
  const Cloud cloud = ball_before_a_sheet();
  const View view = View().for_paper();
  const Surface surface = value_of(paper::find_surface(*value_of(MeasuredCloud::measure(cloud, view)), view));
  const auto heights_of = [&](std::size_t control_points) {
    const PaperModel model = value_of(PaperModel::prepare(surface, control_points));
    EXPECT_EQ(model.is_subspace(), control_points < surface.points.size());
    auto solve = model.make_solve_workspace();
    auto map = model.make_map_workspace();
    std::vector<float> control(model.control_points()), heights(model.size());
    model.solve({}, solve, control);
    model.map(control, .02, map, heights);
    return heights;
  };
  const std::vector<float> exact = heights_of(surface.points.size()), mapped = heights_of(4000);
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) sum += std::pow(exact[i] - mapped[i], 2);
  const double span = *std::ranges::max_element(exact) - *std::ranges::min_element(exact);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(exact.size())), .03 * span);
}

TEST(PaperRelief, AndItsFramesAreTheSame) {
  for (const Mode mode : {Mode::exact, Mode::subspace}) {
    const ReliefModel model = prepared(ball_before_a_sheet(), mode);
    FrameMaker maker(model);
    Frame frame;
    FrameOptions options{Shape{{1, .2}, .05}, std::nullopt, nullptr};
    maker.make(options, frame);
    const Relief relief = model.make(options.shape);
    for (std::size_t i = 0; i < relief.heights.size(); ++i)
      EXPECT_EQ(frame.heights[i], static_cast<float>(relief.heights[i]));

    options.height = .1;
    options.shape.is_beta_free = true;
    options.base = std::make_shared<const std::vector<float>>(relief.heights.size(), 2.F);
    for (int again = 0; again < 2; ++again) {  // the second time, the coefficients are known
      maker.make(options, frame);
      EXPECT_TRUE(frame.is_height_met);
      EXPECT_NEAR(frame.height, .1, 1e-6);
      EXPECT_NEAR(*std::ranges::max_element(frame.heights), 2.1, .01);
      if (again > 0) {
        EXPECT_EQ(frame.times.solves, 1);
      }
    }
  }
}

}  // namespace
}  // namespace relievo
