#include "relievo/relief/layers.h"

#include <algorithm>
#include <cmath>

#include "geometry/extent.h"
#include "relievo/core/parallel.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

// Of the longer side: the Gaussians between the layers.
constexpr double finest = .0045, middling = .058, coarsest = .12;
// The slope, 85 degrees, at which half of a normal's x and y is left.
constexpr double steepest_kept = 12;

// How far layers are held back, of the exponent 25 detail.
constexpr double middle_share = .4, coarse_share = .82, broad_share = 2.2;

// -(n_x, n_y), which fades out where the surface turns away from the viewer: such slopes spend height and
// show little.
Vec2f falling_off(const Vec3f& normal) {
  const double slope =
      static_cast<double>(normal.head<2>().norm()) / std::max(static_cast<double>(normal.z()), 1e-3);
  return static_cast<float>(-1 / (1 + std::pow(slope / steepest_kept, 8))) * normal.head<2>();
}

}  // namespace

std::vector<PointLayers> normal_layers(std::span<const Vec3> points, std::span<const Vec3f> normals) {
  std::vector<PointLayers> layers(points.size());
  const double longer_side = longer_side_of(points);
  if (!(longer_side > 0)) return layers;
  std::vector<Vec2f> kept(points.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = falling_off(normals[i]);
  const auto smoothed = [&](std::vector<Vec2f> values, double width) {
    SurfaceBlur(points, width * longer_side).apply(values);
    return values;
  };
  const std::vector<Vec2f> smooth = smoothed(kept, finest), smoother = smoothed(smooth, middling),
                           smoothest = smoothed(smoother, coarsest);
  parallel_for(layers.size(), [&](std::size_t i) {
    layers[i] = {Vec2f(kept[i] - smooth[i]), Vec2f(smooth[i] - smoother[i]),
                 Vec2f(smoother[i] - smoothest[i]), smoothest[i]};
  });
  return layers;
}

LayerWeights LayerWeights::of(double u, double detail, double held) {
  const auto kept = [&](double share) {
    return static_cast<float>(u > 0 ? (held - 2) * std::expm1(-u * std::exp(-25 * detail * share)) : 0);
  };
  return {kept(0), kept(middle_share), kept(coarse_share), kept(broad_share), static_cast<float>(held)};
}

}  // namespace relievo
