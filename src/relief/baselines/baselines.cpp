#include "relief/baselines/scaled.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/height_span.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/baselines.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

// Blurs heights. Distances are measured in the view plane instead of space, because the solution of equation
// (9) has no jumps. A single blur is piecewise linear over cells as wide as its Gaussian, and amplified
// detail would show these cells. So sixteen narrow blurs replace one wide blur.
std::vector<Vec2f> smoothed(const std::vector<double>& heights, const Surface& surface, double sigma) {
  std::vector<Vec3> flat = surface.points;
  for (Vec3& p : flat) p.z() = 0;
  const SurfaceBlur blur(flat, sigma / 4);
  std::vector<Vec2f> smooth(heights.size());
  for (std::size_t i = 0; i < smooth.size(); ++i) smooth[i] = {static_cast<float>(heights[i]), 0};
  for (int pass = 0; pass < 16; ++pass) blur.apply(smooth);
  return smooth;
}

// Splits the field into its bands, weights them and adds them up again.
void weigh_bands(std::vector<Vec2f>& field, const Surface& surface, const GradientOptions& options) {
  std::vector<Vec2f> sum(field.size(), Vec2f::Zero());
  double sigma = options.finest_band * surface.longer_side();
  for (std::size_t band = 0; band < options.band_weights.size(); ++band, sigma *= 2) {
    const auto weight = static_cast<float>(options.band_weights[band]);
    const std::vector<Vec2f> whole = field;
    if (band + 1 < options.band_weights.size())
      SurfaceBlur(surface.points, sigma).apply(field);
    else
      field.assign(field.size(), Vec2f::Zero());
    for (std::size_t i = 0; i < field.size(); ++i) sum[i] += weight * (whole[i] - field[i]);
  }
  field = std::move(sum);
}

}  // namespace

std::vector<double> base_and_detail_heights(const Surface& surface, const HeightSystem& system,
                                            const DetailOptions& options) {
  std::vector<Vec2> slopes(surface.points.size());
  parallel_for(slopes.size(), [&](std::size_t i) { slopes[i] = moderate_slope(surface.normals[i]); });
  std::vector<double> heights(slopes.size());
  system.solve(slopes, heights);
  const std::vector<Vec2f> smooth = smoothed(heights, surface, options.scale * surface.longer_side());
  std::vector<double> z = depths(surface);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] += options.amplification * (heights[i] - static_cast<double>(smooth[i].x()));
  return z;
}

Relief base_and_detail_relief(const ReliefModel& model, double height, const DetailOptions& options) {
  return scaled_relief(base_and_detail_heights(model.surface(), *model.system(), options), model.surface(),
                       height);
}

Relief base_and_detail_relief(const ReliefModel& model, double height) {
  return base_and_detail_relief(model, height, DetailOptions{});
}

Relief linear_relief(const Surface& surface, double height) {
  return scaled_relief(depths(surface), surface, height);
}

Relief linear_relief(const ReliefModel& model, double height) {
  return linear_relief(model.surface(), height);
}

std::vector<double> gradient_heights(const Surface& surface, const HeightSystem& system,
                                     const GradientOptions& options) {
  const std::vector<Vec2> slopes = gradient_slopes(surface, options);
  std::vector<double> heights(slopes.size());
  system.solve(slopes, heights);
  return heights;
}

Relief gradient_relief(const ReliefModel& model, double height, const GradientOptions& options) {
  return scaled_relief(gradient_heights(model.surface(), *model.system(), options), model.surface(), height);
}

Relief gradient_relief(const ReliefModel& model, double height) {
  return gradient_relief(model, height, GradientOptions{});
}

Relief scaled_relief(std::vector<double> heights, const Surface& surface, double height) {
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (surface.boundary.is_boundary[i]) heights[i] = 0;
  const double span = height_span(heights);
  if (!(span > 0)) return {std::move(heights), 0, {}};
  for (double& z : heights) z *= height / span;
  return {std::move(heights), height, {}};
}

std::vector<double> depths(const Surface& surface) {
  double deepest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : surface.points) deepest = std::min(deepest, p.z());
  std::vector<double> z;
  z.reserve(surface.points.size());
  for (const Vec3& p : surface.points) z.push_back(p.z() - deepest);
  return z;
}

Vec2 slope_of(const Vec3f& normal) {
  const Vec3 n = normal.cast<double>();
  return -n.head<2>() / std::max(n.z(), 1e-3);
}

Vec2 moderate_slope(const Vec3f& normal) {
  constexpr double steepest = 4;
  const Vec2 slope = slope_of(normal);
  return slope * std::min(1.0, steepest / std::max(slope.norm(), 1e-9));
}

Vec2 attenuated(const Vec2& gradient, double a) {
  const double length = gradient.norm();
  return length > 0 ? Vec2(gradient * (std::log1p(a * length) / (a * length))) : Vec2(Vec2::Zero());
}

std::vector<Vec2> gradient_slopes(const Surface& surface, const GradientOptions& options) {
  std::vector<Vec2f> field(surface.points.size());
  parallel_for(field.size(), [&](std::size_t i) {
    const Vec2 g = slope_of(surface.normals[i]);
    field[i] = g.norm() > options.steepest_kept ? Vec2f(Vec2f::Zero())
                                                : attenuated(g, options.attenuation).cast<float>();
  });
  if (options.band_weights.size() > 1) weigh_bands(field, surface, options);
  std::vector<Vec2> slopes(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) slopes[i] = field[i].cast<double>();
  return slopes;
}

}  // namespace relievo
