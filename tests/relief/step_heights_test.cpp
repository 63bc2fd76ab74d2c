#include "relief/step_heights.h"

#include <array>

#include "relievo/relief/frame.h"
#include "support/differences.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

// The depths of three square terraces, as seen from above. Each terrace is half as wide as the one below it,
// and the two steps have different heights.
constexpr std::array<double, 3> depths = {0, .3, .7};

std::size_t terrace_of(const Vec3& p) {
  const double out = std::max(std::abs(p.x()), std::abs(p.y()));
  return out > .5 ? 0 : out > .25 ? 1 : 2;
}

Cloud terraces(std::size_t n, double bulge = 0) {
  Cloud cloud = test::height_field(
      n, 1, [=](double x, double y) { return bulge * (2 - x * x - y * y); },
      [=](double x, double y) { return Vec2(-2 * bulge * x, -2 * bulge * y); });
  for (Vec3& p : cloud.points) p.z() += depths[terrace_of(p)];
  return cloud;
}

Shape plain(double steps = 0) {
  Shape shape{{1, 0}};
  shape.steps = steps;
  return shape;
}

// Returns the largest error of the heights. Points within 2.5 sampling distances of the terraces' edges do
// not count, because the positions of these edges follow from the points only with that accuracy.
double largest_error(const ReliefModel& model, std::span<const double> heights, double scale) {
  double worst = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Vec3& p = model.surface().points[i];
    const double out = std::max(std::abs(p.x()), std::abs(p.y())), unknown = 2.5 * model.surface().rho;
    if (std::abs(out - .5) < unknown || std::abs(out - .25) < unknown) continue;
    worst = std::max(worst, std::abs(heights[i] - scale * depths[terrace_of(p)]));
  }
  return worst;
}

// The equations of the least squares contain the differences of the terraces' depths. Heights can satisfy
// these equations exactly.
TEST(StepHeights, OfTerracesAreTheirDepths) {
  const ReliefModel model = test::prepared(terraces(20000));
  const StepHeights& steps = model.steps();
  ASSERT_FALSE(steps.empty());
  EXPECT_NEAR(steps.span, .7, 1e-6);
  EXPECT_LT(largest_error(model, {std::vector<double>(steps.z.begin(), steps.z.end())}, 1), 1e-5);
}

TEST(StepHeights, ThereAreNoneWithoutAJump) {
  EXPECT_TRUE(test::prepared(test::sphere(20000, 1)).steps().empty());
}

// A step grows from 0 to 6 rho along its edge. Its wall must rise everywhere, even where the depths differ
// too little for a depth jump.
TEST(Planes, StepWhereverTheDepthDoes) {
  constexpr double growth = .0425, scale = .05 * 2;
  const auto step = [](double y) { return growth * (1 + y); };
  const ReliefModel model = test::prepared(test::height_field(
      20000, 1, [=](double x, double y) { return x < 0 ? step(y) : 0; },
      [=](double x, double) -> Vec2 {
        return {0, x < 0 ? growth : 0};
      }));
  const Surface& surface = model.surface();
  std::size_t count = 0, low = 0;
  for (const Triangle& corners : surface.triangulation.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners[k], b = corners[(k + 1) % 3];
      const double y = (surface.points[a] + surface.centre).y();
      const double depth = surface.points[a].z() - surface.points[b].z();
      if (!surface.boundary.is_across_wall(a, b) || std::abs(y) > .8 || depth < surface.rho) continue;
      ++count;
      const auto height = static_cast<double>(model.planes().z[a] - model.planes().z[b]);
      low += height < .5 * std::tanh(depth / scale);
    }
  ASSERT_GT(count, 100);
  EXPECT_LT(low, .02 * static_cast<double>(count));
}

// The surface is like a chin: within 3 rho of its edge, the front falls from 0.2 to 0.05 above the back, along a
// quarter of an ellipse. The step must follow the depth between both parts, not the 0.05 between the rows of points at
// the wall.
TEST(Planes, StepByTheDepthOfAPartThatTurnsAway) {
  constexpr double top = .2, edge = .05, width = .042, scale = .05 * 2;
  const auto chin = [=](double x) {
    return x < -width ? top : edge + (top - edge) * std::sqrt(std::max(0., 1 - std::pow(x / width + 1, 2)));
  };
  const auto slope = [=](double x) {
    return x < -width ? 0 : -std::pow((top - edge) / width, 2) * (x + width) / std::max(chin(x) - edge, 1e-3);
  };
  const ReliefModel model = test::prepared(test::height_field(
      20000, 1, [=](double x, double) { return x < 0 ? chin(x) : 0; },
      [=](double x, double) -> Vec2 {
        return {x < 0 ? slope(x) : 0, 0};
      }));
  const Surface& surface = model.surface();
  std::size_t count = 0, low = 0;
  for (const Triangle& corners : surface.triangulation.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners[k], b = corners[(k + 1) % 3];
      if (!surface.boundary.is_across_wall(a, b) || surface.points[a].z() < surface.points[b].z()) continue;
      const Vec3 p = surface.points[a] + surface.centre;
      if (std::abs(p.x()) > width / 2 || std::abs(p.y()) > .8) continue;  // a crease, or the silhouette
      ++count;
      low += model.planes().z[a] - model.planes().z[b] < std::tanh(1.2 * edge / scale);
    }
  ASSERT_GT(count, 100);
  EXPECT_LT(low, .02 * static_cast<double>(count));
}

TEST(Steps, ReachAHeightThatSlopesDoNot) {
  const ReliefModel model = test::prepared(terraces(20000));
  for (const double height : {.01, .2, .699}) {
    const auto relief = value_of(model.make_at_height(height, plain(), 1));
    EXPECT_LT(largest_error(model, relief.heights, height / .7), 1e-5 * height);
    EXPECT_NEAR(relief.shape.steps, 1, 1e-4);
  }
}

TEST(Steps, AreNoDeeperThanInTheModel) {
  const ReliefModel model = test::prepared(terraces(20000));
  expect_error(model.make_at_height(.71, plain(), 10), "at most 7");
  FrameMaker maker(model);
  Frame frame;
  maker.make({plain(), .71}, frame);
  EXPECT_FALSE(frame.is_height_met);
  EXPECT_NEAR(frame.height, .7, 1e-4);
}

TEST(Steps, TakeNothingWhereSlopesReachTheHeight) {
  const ReliefModel model = test::prepared(terraces(20000, .3));
  const auto relief = value_of(model.make_at_height(.1, plain(), 1));
  EXPECT_EQ(relief.shape.steps, 0);
  EXPECT_NEAR(relief.heights[0], model.make(relief.shape).heights[0], 1e-6);
}

// If steps get the fraction S of the height h, the heights must be those that slopes give, plus the step
// heights times S h / span.
TEST(Steps, TakeTheShareAskedFor) {
  const ReliefModel model = test::prepared(terraces(20000, .3));
  const double height = .1, share = .4;
  const Relief relief = model.make_at_height(height, plain(share), 1).value();
  EXPECT_EQ(relief.shape.steps, share);
  Shape slopes_alone = relief.shape;
  slopes_alone.steps = 0;
  const Relief slopes = model.make(slopes_alone);
  const double factor = share * height / model.steps().span;
  for (std::size_t i = 0; i < slopes.heights.size(); ++i)
    ASSERT_NEAR(relief.heights[i], slopes.heights[i] + factor * static_cast<double>(model.steps().z[i]),
                2e-5 * height);
}

TEST(Steps, TakeTheShareOfAFreeHeightToo) {
  const ReliefModel model = test::prepared(terraces(20000, .3));
  const Relief slopes = model.make(plain()), relief = model.make(plain(.4));
  // Slopes and steps are both highest at the centre, so their heights add up.
  EXPECT_NEAR(relief.height, slopes.height / .6, .02 * relief.height);
}

TEST(Steps, FramesAreTheRelief) {
  for (const double bulge : {0., .3}) {
    const ReliefModel model = test::prepared(terraces(20000, bulge));
    FrameMaker maker(model);
    Frame frame;
    for (const double share : {0., .4}) {
      for (const double height : {.1, .3}) {
        const Relief relief = model.make_at_height(height, plain(share), 1).value();
        maker.make({plain(share), height}, frame);
        EXPECT_TRUE(frame.is_height_met);
        EXPECT_NEAR(frame.height, height, 1e-3 * height);
        EXPECT_LT(test::largest_difference(frame.heights, relief.heights), 2e-3 * height)
            << bulge << " " << share << " " << height;
      }
    }
  }
}

TEST(Steps, LevelPartsOfLayeredReliefsStayLevel) {
  const ReliefModel model = test::prepared(terraces(20000));
  const Relief relief = model.make_at_height(.2, layered_shape(), 1).value();
  EXPECT_NEAR(relief.height, .2, 1e-9);
  EXPECT_LT(largest_error(model, relief.heights, .2 / .7), 1e-5 * .2);
}

// The height correction also applies if steps get a part of the height. The terraces must then be in the
// order of their depths.
TEST(Steps, OfLayeredReliefsKeepTheOrderOfDepths) {
  const ReliefModel model = test::prepared(terraces(20000, .3));
  Shape shape = layered_shape();
  shape.steps = .8;
  const Relief relief = model.make_at_height(.2, shape, 1).value();
  EXPECT_NEAR(relief.height, .2, 1e-9);
  std::array<double, 3> mean{}, points{};
  for (std::size_t i = 0; i < relief.heights.size(); ++i) {
    const std::size_t k = terrace_of(model.surface().points[i]);
    mean[k] += relief.heights[i], ++points[k];
  }
  for (std::size_t k = 0; k < 3; ++k) mean[k] /= points[k];
  EXPECT_LT(mean[0] + .02, mean[1]);
  EXPECT_LT(mean[1] + .02, mean[2]);
}

}  // namespace
}  // namespace relievo
