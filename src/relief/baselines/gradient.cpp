#include "relief/baselines/scaled.h"
#include "relievo/relief/baselines.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"

namespace relievo {

Relief gradient_relief(const ReliefModel& model, double height, const GradientOptions& options) {
  const std::vector<Vec2> slopes = gradient_slopes(model.surface(), options);
  std::vector<double> heights(slopes.size());
  model.system()->solve(slopes, heights);
  return scaled_relief(std::move(heights), model.surface(), height);
}

Relief gradient_relief(const ReliefModel& model, double height) {
  return gradient_relief(model, height, GradientOptions{});
}

}  // namespace relievo
