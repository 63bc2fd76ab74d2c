#include "yardstick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "jumps.h"
#include "relievo/detail.h"
#include "relievo/quality/measures.h"
#include "relievo/relief.h"
#include "relievo/relief/baselines.h"
#include "relievo/samples/sample.h"
#include "slope_input.h"
#include "support/shapes.h"

namespace relievo {
namespace {

HeightSystem system_of(const Surface& surface) {
  std::vector<Vec2> plane;
  for (const Vec3& p : surface.points) plane.push_back(p.head<2>());
  return HeightSystem::build(plane, surface.triangulation, surface.boundary, jump_weights(surface)).value();
}

// With what it views.
struct Figure {
  explicit Figure(const Cloud& cloud) : surface(find_surface(cloud, {}).value()) {}

  Surface surface;
  Membrane membrane{surface, jump_weights(surface)};
  HeightSystem system = system_of(surface);
  Yardstick yardstick{surface, membrane, system};
};

Cloud shell() {
  return make_sample("shell", {60000}).value();
}

Shape shape_for(double u, const Hold& hold) {
  Shape shape = layered_shape();
  shape.compression.u = u;
  shape.hold = hold;
  return shape;
}

// Against whole reliefs, made and judged as anyone would.
TEST(Yardstick, TellsWhatAReliefLacks) {
  const Figure figure(shell());
  const ReliefModel model = ReliefModel::prepare(figure.surface).value();
  const Judge judge(figure.surface);
  for (const double u : {.3, 2.0})
    for (const Hold& hold : {Hold{.3, .2}, {.8, .05}}) {
      const Relief relief = model.make(shape_for(u, hold));
      const Measures ours = judge.measure(relief.heights),
                     rival = judge.measure(gradient_relief(model, relief.height).heights);
      const Kept lacking = figure.yardstick.lacking(figure.yardstick.heights(u, hold), hold);
      EXPECT_NEAR(lacking.detail, rival.detail[2] - ours.detail[2], 1e-5) << u;
      EXPECT_NEAR(lacking.order, rival.order - ours.order, 1e-4) << u;
    }
}

// Held, they are the relief's own.
TEST(Yardstick, FindsHeightsNotYetHeld) {
  const Figure figure(shell());
  const ReliefModel model = ReliefModel::prepare(figure.surface).value();
  const std::vector<float> weights = boundary_weights(
      figure.surface.boundary.distance, boundary_rho(figure.surface, layered_shape().boundary_width));
  Membrane::Workspace workspace = figure.membrane.make_workspace();
  for (const Hold& hold : {Hold{.3, .2}, {1, .05}}) {
    std::vector<double> heights = figure.yardstick.heights(1, hold);
    const double height = hold.share * height_span(heights);
    figure.membrane.hold<double>({heights, weights, Membrane::Limits::of(height, hold)}, workspace);
    const Relief relief = model.make(shape_for(1, hold));
    for (std::size_t i = 0; i < heights.size(); ++i)
      ASSERT_NEAR(heights[i], relief.heights[i], 1e-3 * relief.height);
  }
}

TEST(Yardstick, IsOfNoUseWhereNothingCanBeSeenOrCompressed) {
  const auto is_of_use = [](const Cloud& cloud) { return Figure(cloud).yardstick.is_of_use(); };
  Cloud strip = test::torus(3000, 1, .4);
  for (Vec3& p : strip.points) p.x() *= .005;
  EXPECT_FALSE(is_of_use(strip));
  EXPECT_FALSE(is_of_use(test::sheet(60000, 1, 0)));
  EXPECT_TRUE(is_of_use(test::torus(60000, 1, .4)));
}

}  // namespace
}  // namespace relievo
