#include <algorithm>

#include "relief/baselines/scaled.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/baselines.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

// Returns the slopes of the normals, shortened to 76 degrees, the default of our own Shape::max_slope: a few
// steeper ones at silhouettes would take most of the height.
std::vector<Vec2> moderate_slopes(const Surface& surface) {
  constexpr double steepest = 4;
  std::vector<Vec2> slopes(surface.points.size());
  parallel_for(slopes.size(), [&](std::size_t i) {
    const Vec2 slope = slope_of(surface.normals[i]);
    slopes[i] = slope * std::min(1.0, steepest / std::max(slope.norm(), 1e-9));
  });
  return slopes;
}

// Blurs in the view plane, where these heights have no jumps. The cells of a blur are as wide as its Gaussian
// and would show once amplified, so sixteen narrow blurs take the place of one.
std::vector<Vec2f> smoothed(const std::vector<double>& heights, const Surface& surface, double sigma) {
  std::vector<Vec3> flat = surface.points;
  for (Vec3& p : flat) p.z() = 0;
  const SurfaceBlur blur(flat, sigma / 4);
  std::vector<Vec2f> smooth(heights.size());
  for (std::size_t i = 0; i < smooth.size(); ++i) smooth[i] = {static_cast<float>(heights[i]), 0};
  for (int pass = 0; pass < 16; ++pass) blur.apply(smooth);
  return smooth;
}

}  // namespace

Relief base_and_detail_relief(const ReliefModel& model, double height, const DetailOptions& options) {
  const Surface& surface = model.surface();
  const std::vector<Vec2> slopes = moderate_slopes(surface);
  std::vector<double> heights(slopes.size());
  model.system()->solve(slopes, heights);
  const std::vector<Vec2f> smooth = smoothed(heights, surface, options.scale * surface.longer_side());
  std::vector<double> z = depths(surface);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] += options.amplification * (heights[i] - static_cast<double>(smooth[i].x()));
  return scaled_relief(std::move(z), surface, height);
}

Relief base_and_detail_relief(const ReliefModel& model, double height) {
  return base_and_detail_relief(model, height, DetailOptions{});
}

}  // namespace relievo
