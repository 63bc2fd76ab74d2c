#include "relief/colour_lines.h"

#include "core/height_span.h"
#include "support/strokes.h"

namespace relievo {
namespace {

// Returns the cloud with dark colours where is_dark(point) is true, and white elsewhere.
template <typename IsDark>
Cloud coloured(Cloud cloud, IsDark is_dark) {
  for (const Vec3& p : cloud.points)
    cloud.colours.push_back(is_dark(p) ? Colour{20, 20, 20} : Colour{230, 230, 230});
  return cloud;
}

TEST(DarkLines, AreFullOnStripesAndNothingElsewhere) {
  const Surface surface = test::surface_of(
      coloured(test::sheet(30000, 1, 0), [](const Vec3& p) { return std::abs(p.x() - .2) < .04; }));
  const std::vector<float> lines = dark_lines(surface);
  ASSERT_EQ(lines.size(), surface.points.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Vec3& p = surface.points[i];
    if (p.head<2>().cwiseAbs().maxCoeff() > .9) continue;
    const double distance = std::abs(p.x() - .2);
    if (distance < .015) EXPECT_GT(lines[i], .99F) << p.transpose();
    if (distance > .08) {
      EXPECT_EQ(lines[i], 0) << p.transpose();
    }
  }
}

TEST(DarkLines, AreTheEdgesOfWideDarkAreas) {
  const Surface surface =
      test::surface_of(coloured(test::sheet(30000, 1, 0), [](const Vec3& p) { return p.x() < 0; }));
  const std::vector<float> lines = dark_lines(surface);
  float most = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (surface.points[i].x() < -.2 || surface.points[i].x() > .05) EXPECT_EQ(lines[i], 0);
    most = std::max(most, lines[i]);
  }
  EXPECT_GT(most, .9F);
}

TEST(DarkLines, NeedColours) {
  EXPECT_TRUE(dark_lines(test::surface_of(test::sheet(30000, 1, 0))).empty());
  const Surface even = test::surface_of(coloured(test::sheet(30000, 1, 0), [](const Vec3&) { return true; }));
  EXPECT_EQ(std::ranges::max(dark_lines(even)), 0);
}

TEST(SinkLines, LowerByTheDepthButNotBelowTheBase) {
  const std::vector<float> lines{0, 1, .5F, 1, 0};
  std::vector<double> z{1, .8, .6, .1, 0};
  sink_lines<double>(lines, .2, z);
  const std::vector<double> wanted{1, .6, .5, 0, 0};
  for (std::size_t i = 0; i < z.size(); ++i) EXPECT_DOUBLE_EQ(z[i], wanted[i]);
}

TEST(SinkLines, KeepTheHeightIfTheTopIsOnALine) {
  const std::vector<float> lines{1, 0, .5F};
  std::vector<double> z{1, .7, .4};
  sink_lines<double>(lines, .2, z);
  // The heights are multiplied by 1.2, then lines are sunk. The results are 1.2 - 0.2, 0.84 and
  // 0.48 - 0.1.
  EXPECT_NEAR(z[0], 1, 1e-6);
  EXPECT_NEAR(z[1], .84, 1e-6);
  EXPECT_NEAR(z[2], .38, 1e-6);
}

TEST(SinkLines, AreExactlyAsDeepInReliefsAndFrames) {
  const Cloud ball =
      coloured(test::sphere(20000, 1), [](const Vec3& p) { return std::abs(p.x() - .3) < .03; });
  const ReliefModel model = test::prepared(ball);
  Shape lined = layered_shape();
  lined.line_depth = .01;
  const Relief plain = value_of(model.make_at_height(.2, layered_shape(), 1)),
               sunk = value_of(model.make_at_height(.2, lined, 1));
  EXPECT_EQ(height_span(sunk.heights), .2);
  const std::vector<float> lines = dark_lines(model.surface());
  EXPECT_GT(std::ranges::count_if(lines, [](float line) { return line > .9F; }), 50);
  const Frame level = test::frame_of(model, {}), frame = test::frame_of(model, {lined});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double depth = .01 * static_cast<double>(lines[i]);
    EXPECT_NEAR(sunk.heights[i], std::max(plain.heights[i] - depth, 0.0), 1e-6);
    EXPECT_NEAR(static_cast<double>(frame.heights[i]),
                std::max(static_cast<double>(level.heights[i]) - depth, 0.0),
                2e-5);  // tolerance: the highest point may be on a line
  }
}

}  // namespace
}  // namespace relievo
