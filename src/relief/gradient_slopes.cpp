#include "relievo/relief/gradient_slopes.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/parallel.h"
#include "relievo/scan/surface.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

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

Vec2 slope_of(const Vec3f& normal) {
  const Vec3 n = normal.cast<double>();
  return -n.head<2>() / std::max(n.z(), 1e-3);
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
