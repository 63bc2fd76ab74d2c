#include <algorithm>

#include "relievo/parallel.h"
#include "relievo/rivals.h"
#include "scaled.h"
#include "surface_blur.h"

namespace relievo {

Relief base_and_detail_relief(const ReliefModel& model, double height, const DetailOptions& options) {
  const Surface& surface = model.surface();
  const std::size_t n = surface.points.size();
  std::vector<Vec2> slopes(n);
  for (std::size_t i = 0; i < n; ++i) {
    slopes[i] = slope_of(surface.normals[i]);
    slopes[i] *= std::min(1.0, 4 / std::max(slopes[i].norm(), 1e-9));
  }
  std::vector<double> heights(n);
  model.system()->solve(slopes, heights);

  std::vector<Vec2f> smooth(n);
  for (std::size_t i = 0; i < n; ++i) smooth[i] = {static_cast<float>(heights[i]), 0};
  // A blur's cells are as wide as its Gaussian and would show once amplified: four narrow ones instead of
  // one.
  const SurfaceBlur blur(surface.points, options.scale * longer_side(surface) / 2);
  for (int pass = 0; pass < 4; ++pass) blur.apply(smooth);
  std::vector<double> z = depths(surface);
  for (std::size_t i = 0; i < n; ++i)
    z[i] += options.amplification * (heights[i] - static_cast<double>(smooth[i].x()));
  return scaled_relief(std::move(z), surface, height);
}

}  // namespace relievo
