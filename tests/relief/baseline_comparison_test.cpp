#include "relief/membrane/membrane_tuning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/height_span.h"
#include "relief/style.h"
#include "relievo/quality/measures.h"
#include "relievo/relief/baselines.h"
#include "relievo/relief/relief.h"
#include "relievo/samples/sample.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"
#include "support/differences.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// A comparison, and the objects that it refers to.
struct Figure {
  explicit Figure(const Cloud& cloud) : surface(find_surface(cloud, {}).value()) {}

  Surface surface;
  std::vector<PointLayers> layers = normal_layers(surface.points, surface.normals);
  std::vector<float> weights = jump_weights(surface);
  HeightCorrection correction{surface, weights};
  HeightSystem system =
      HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary, weights).value();
  JumpLift jump_lift = JumpLift::find({surface, layers, system});
  BaselineComparison comparison{{surface, layers, correction, system, jump_lift}};
};

Cloud shell() {
  return make_sample("shell", {60000}).value();
}

Shape shape_for(double u, const MembraneParams& params) {
  Shape shape = layered_shape();
  shape.compression.u = u;
  shape.membrane = params;
  return shape;
}

// The deficit agrees with that of whole reliefs, measured by ReliefMetrics.
TEST(BaselineComparison, ReturnsTheDeficit) {
  const Figure figure(shell());
  const ReliefModel model = ReliefModel::prepare(figure.surface).value();
  const ReliefMetrics metrics(figure.surface);
  for (const double u : {.3, 2.0})
    for (const MembraneParams& params : {MembraneParams{.3, .2}, {.8, .05}}) {
      const Relief relief = model.make(shape_for(u, params));
      const Measures ours = metrics.measure(relief.heights),
                     baseline = metrics.measure(gradient_relief(model, relief.height).heights);
      const Scores deficit = figure.comparison.deficit(figure.comparison.heights(u, params), params);
      EXPECT_NEAR(deficit.detail, baseline.detail[2] - ours.detail[2], 1e-5) << u;
      EXPECT_NEAR(deficit.order, baseline.order - ours.order, 1e-4) << u;
    }
}

// If the comparison's heights are compressed, they are those of the whole relief.
TEST(BaselineComparison, FindsHeightsBeforeCompression) {
  const Figure figure(shell());
  const ReliefModel model = ReliefModel::prepare(figure.surface).value();
  const std::vector<float> weights = boundary_weights(
      figure.surface.boundary.distance, boundary_rho(figure.surface, layered_shape().boundary_width));
  HeightCorrection::Workspace workspace = figure.correction.make_workspace();
  for (const MembraneParams& params : {MembraneParams{.3, .2}, {1, .05}}) {
    std::vector<double> heights = figure.comparison.heights(1, params);
    const double height = params.height_share * height_span(heights);
    figure.correction.compress_heights<double>({heights, weights, HeightLimits::of(height, params)},
                                               workspace);
    const Relief relief = model.make(shape_for(1, params));
    EXPECT_LE(test::largest_difference(heights, relief.heights), 1e-3 * relief.height);
  }
}

TEST(BaselineComparison, IsNotMeasurableWhereNothingCanBeSeenOrCompressed) {
  const auto is_measurable = [](const Cloud& cloud) { return Figure(cloud).comparison.is_measurable(); };
  Cloud strip = test::torus(3000, 1, .4);
  for (Vec3& p : strip.points) p.x() *= .005;
  EXPECT_FALSE(is_measurable(strip));
  EXPECT_FALSE(is_measurable(test::sheet(60000, 1, 0)));
  EXPECT_TRUE(is_measurable(test::torus(60000, 1, .4)));
}

}  // namespace
}  // namespace relievo
