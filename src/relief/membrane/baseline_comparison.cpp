#include "relief/membrane/baseline_comparison.h"

#include "relief/height_span.h"
#include "relief/style.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/gradient_slopes.h"

namespace relievo {
namespace {

// With fewer pixels than this the scores are noise.
constexpr std::size_t least_pixels = 100;

}  // namespace

BaselineComparison::BaselineComparison(const TuningInput& input)
    : input_(input),
      metrics_(input.surface),
      boundary_weight_(boundary_weights(input.surface.boundary.distance,
                                        boundary_rho(input.surface, layered_shape().boundary_width))),
      baseline_(solved(gradient_slopes(input.surface))),
      baseline_span_(height_span(baseline_)) {}

bool BaselineComparison::is_measurable() const {
  return metrics_.pixels() >= least_pixels && baseline_span_ > 0;
}

std::vector<double> BaselineComparison::solved(std::span<const Vec2> slopes) const {
  std::vector<Vec2f> single(slopes.size());
  parallel_for(slopes.size(), [&](std::size_t i) { single[i] = slopes[i].cast<float>(); });
  std::vector<float> heights(slopes.size());
  HeightSystem::Workspace workspace = input_.system.make_workspace();
  input_.system.solve(single, heights, workspace);
  return {heights.begin(), heights.end()};
}

std::vector<double> BaselineComparison::heights(double u, const MembraneParams& params) const {
  Shape shape = layered_shape();
  shape.compression.u = u;
  shape.membrane = params;
  std::vector<Vec2> slopes(input_.surface.points.size());
  find_slopes(slope_input(input_.surface, input_.layers, boundary_weight_), shape, slopes);
  std::vector<double> heights = solved(slopes);
  input_.jump_lift.add_to(std::span(heights), shape);
  return heights;
}

Scores BaselineComparison::deficit(std::vector<double> relief, const MembraneParams& params) const {
  std::vector<double> baseline = baseline_;
  const double height = params.height_share * height_span(relief);
  HeightCorrection::Workspace workspace = correction().make_workspace();
  correction().compress_heights<double>({relief, boundary_weight_, HeightLimits::of(height, params)},
                                        workspace);
  for (double& z : baseline) z *= height / baseline_span_;
  const Scores theirs = metrics_.exact_scores(baseline), ours = metrics_.exact_scores(relief);
  return {theirs.detail - ours.detail, theirs.order - ours.order};
}

}  // namespace relievo
