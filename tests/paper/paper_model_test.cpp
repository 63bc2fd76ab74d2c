#include "paper/paper_model.h"

#include <array>

#include "paper/surface.h"
#include "relievo/relief/frame.h"
#include "relievo/relief/relief.h"
#include "support/differences.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

ReliefModel prepared(const Cloud& cloud, Mode mode = Mode::exact) {
  const View view = View().for_paper();
  return value_of(ReliefModel::of_view(*value_of(MeasuredCloud::measure(cloud, view)), view, {mode}));
}

Cloud ball_before_a_sheet(double distance = 2) {
  return test::joined(test::sheet(24000, 1.5, 0), test::moved(test::sphere(12000, .7), Vec3(0, 0, distance)));
}

// Section 4.1 of the paper: large depth jumps vanish. Only normals matter, so the relief does not depend on
// the distance between ball and sheet.
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
    if (model.surface().boundary.is_boundary[i]) EXPECT_EQ(relief.heights[i], 0);
}

// The second equation (9) of the paper changes the height of each inner point by gamma k h.
TEST(PaperRelief, DetailIsProportionalToCurvature) {
  const ReliefModel model = prepared(ball_before_a_sheet());
  const Relief plain = model.make({{1, .01}, 0}), detailed = model.make({{1, .01}, .1});
  for (std::size_t i = 0; i < plain.heights.size(); ++i)
    if (!model.surface().boundary.is_boundary[i])
      EXPECT_NEAR(detailed.heights[i] - plain.heights[i],
                  .1 * static_cast<double>(model.surface().curvature.k[i]) * plain.height, 1e-5);
}

// If beta > 1, the exact relief is not a multiple of the uncompressed one. The relief from control points
// must differ from the exact relief less than half as much as the best multiple does.
TEST(PaperRelief, OfControlPointsIsCloseToTheExactOne) {
  const Cloud cloud = test::height_field(
      20000, 1, [](double x, double y) { return .1 * std::sin(4 * x) * std::cos(3 * y); },
      [](double x, double y) {
        return Vec2(.4 * std::cos(4 * x) * std::cos(3 * y), -.3 * std::sin(4 * x) * std::sin(3 * y));
      });
  const View view = View().for_paper();
  const Surface surface = value_of(paper::find_surface(*value_of(MeasuredCloud::measure(cloud, view)), view));
  const auto heights_of = [&](std::size_t control_points, const paper::Coefficients& coefficients) {
    const PaperModel model = value_of(PaperModel::prepare(surface, control_points));
    EXPECT_EQ(model.is_subspace(), control_points < surface.points.size());
    auto solve = model.make_solve_workspace();
    auto map = model.make_map_workspace();
    std::vector<float> control(model.control_points()), heights(model.size());
    model.solve(coefficients, solve, control);
    model.map(control, 0, map, heights);
    return Eigen::Map<const Eigen::VectorXf>(heights.data(), static_cast<Eigen::Index>(heights.size()))
        .eval();
  };
  const std::size_t all = surface.points.size();
  const Eigen::VectorXf reference = heights_of(all, {.u = std::numeric_limits<double>::infinity()});
  for (const double beta : {.01, 2.0, 5.0}) {
    const paper::Coefficients compressed{.u = .5, .beta = beta};
    const Eigen::VectorXf exact = heights_of(all, compressed);
    const Eigen::VectorXf scaled = exact.dot(reference) / reference.squaredNorm() * reference;
    const float error = (heights_of(4000, compressed) - exact).norm();
    EXPECT_LT(error, .03F * std::sqrt(static_cast<float>(all)) * (exact.maxCoeff() - exact.minCoeff()));
    if (beta > 1) EXPECT_LT(error, .5F * (scaled - exact).norm()) << beta;
  }
}

TEST(PaperRelief, AndItsFramesAreTheSame) {
  for (const Mode mode : {Mode::exact, Mode::subspace}) {
    const ReliefModel model = prepared(ball_before_a_sheet(), mode);
    FrameMaker maker(model);
    Frame frame;
    FrameOptions options{Shape{{1, .2}, .05}};
    maker.make(options, frame);
    const Relief relief = model.make(options.shape);
    for (std::size_t i = 0; i < relief.heights.size(); ++i)
      EXPECT_EQ(frame.heights[i], static_cast<float>(relief.heights[i]));

    options.height = .1;
    options.shape.is_beta_free = true;
    for (int again = 0; again < 2; ++again) {  // in the second pass, the coefficients are already known
      maker.make(options, frame);
      EXPECT_TRUE(frame.is_height_met);
      EXPECT_NEAR(frame.height, .1, 1e-6);
      if (again > 0) EXPECT_EQ(frame.times.solves, 1);
    }
  }
}

// Section 3.5 of the paper: the stages of three frames run at the same time. The result must be the same as
// that of frames made one after the other.
TEST(PaperRelief, OneStepAheadHasTheSameBits) {
  const std::array shapes{Shape{{1, .2}, .05}, Shape{{.5, 1}, 0}, Shape{{.7, 0}, .1}, Shape{{.2, 3}, .02}};
  for (const Mode mode : {Mode::exact, Mode::subspace}) {
    const ReliefModel model = prepared(ball_before_a_sheet(), mode);
    FrameMaker maker(model), plain(model);
    Frame ahead, frame;
    for (std::size_t i = 0; i < 2 * shapes.size(); ++i) {
      ASSERT_EQ(maker.make_ahead({shapes[i % shapes.size()], {}}, ahead), i >= 2);
      if (i < 2) continue;
      plain.make({shapes[(i - 2) % shapes.size()], {}}, frame);
      EXPECT_EQ(ahead.options, frame.options);
      EXPECT_EQ(ahead.heights, frame.heights);
      EXPECT_EQ(ahead.normals, frame.normals);
      EXPECT_EQ(ahead.height, frame.height);
    }
    maker.make({shapes[0], {}}, frame);
    EXPECT_FALSE(maker.make_ahead({shapes[0], {}}, frame));
  }
}

}  // namespace
}  // namespace relievo
