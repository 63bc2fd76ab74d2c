#include "relievo/layers.h"

#include <algorithm>
#include <cmath>

#include "extent.h"
#include "relievo/parallel.h"
#include "surface_blur.h"

namespace relievo {
namespace {

// Of the longer side.
constexpr double finest = .006, coarsest = .05, depth_width = .015;
// The slope, 85 degrees, at which half of a normal's x and y is left.
constexpr double steepest_kept = 12;

// How a style divides a relief among the layers.
struct Shares {
  double middle, coarse;  // how far they are held back: of the exponent 25 detail
  double depth;  // the height of all ranks of depth where the fine layer is kept in full, of the longer side
};

Shares shares_of(Style style) {
  return style == Style::raised ? Shares{.22, 1.6, .003} : Shares{.4, 1, .008};
}

// -(n_x, n_y), which fades out where the surface turns away from the viewer: such slopes spend height and
// show little.
Vec2f falling_off(const Vec3f& normal) {
  const double slope =
      static_cast<double>(normal.head<2>().norm()) / std::max(static_cast<double>(normal.z()), 1e-3);
  return static_cast<float>(-1 / (1 + std::pow(slope / steepest_kept, 8))) * normal.head<2>();
}

// Per point the mean of its triangles' gradients, by their areas.
std::vector<Vec2f> gradients(std::span<const Vec3> points, std::span<const Vec2f> values,
                             const Triangulation& triangulation, const Boundary& boundary) {
  std::vector<Vec2> sum(points.size(), Vec2::Zero());
  std::vector<double> area(points.size(), 0.0);
  for (std::size_t t = 0; t < triangulation.triangles.size(); ++t) {
    if (!boundary.is_inside[t]) continue;
    const auto [a, b, c] = triangulation.triangles[t];
    const Vec2 u = (points[b] - points[a]).head<2>(), v = (points[c] - points[a]).head<2>();
    const double du = static_cast<double>(values[b].x() - values[a].x());
    const double dv = static_cast<double>(values[c].x() - values[a].x());
    const Vec2 weighted(du * v.y() - dv * u.y(), dv * u.x() - du * v.x());  // the gradient times the area
    for (const Index corner : {a, b, c}) {
      sum[corner] += weighted;
      area[corner] += u.x() * v.y() - u.y() * v.x();
    }
  }
  std::vector<Vec2f> out(points.size(), Vec2f::Zero());
  for (std::size_t i = 0; i < out.size(); ++i)
    if (area[i] > 0) out[i] = (sum[i] / area[i]).cast<float>();
  return out;
}

std::vector<Vec2f> depth_slopes(std::span<const Vec3> points, double longer_side,
                                const Triangulation& triangulation, const Boundary& boundary) {
  const std::vector<double> ranks = depth_ranks(points);
  std::vector<Vec2f> depth(points.size());
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = {static_cast<float>(longer_side * ranks[i]), 0};
  std::vector<Vec3> flat(points.begin(), points.end());
  for (Vec3& p : flat) p.z() = 0;
  SurfaceBlur(flat, depth_width * longer_side).apply(depth);
  return gradients(points, depth, triangulation, boundary);
}

}  // namespace

std::vector<PointLayers> normal_layers(std::span<const Vec3> points, std::span<const Vec3f> normals,
                                       const Triangulation& triangulation, const Boundary& boundary) {
  std::vector<PointLayers> layers(points.size());
  const double longer_side = longer_side_of(points);
  if (!(longer_side > 0)) return layers;
  std::vector<Vec2f> smooth(points.size()), smoother;
  std::vector<Vec2f> kept(points.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = falling_off(normals[i]);
  smooth = kept;
  SurfaceBlur(points, finest * longer_side).apply(smooth);
  smoother = smooth;
  SurfaceBlur(points, coarsest * longer_side).apply(smoother);
  const std::vector<Vec2f> depth = depth_slopes(points, longer_side, triangulation, boundary);
  parallel_for(layers.size(), [&](std::size_t i) {
    layers[i] = {kept[i] - smooth[i], smooth[i] - smoother[i], smoother[i], depth[i]};
  });
  return layers;
}

LayerWeights LayerWeights::of(double u, double detail, Style style) {
  const Shares shares = shares_of(style);
  const auto kept = [&](double exponent) {
    return static_cast<float>(u > 0 ? -std::expm1(-u * std::exp(-25 * detail * exponent)) : 0);
  };
  const float fine = kept(0);
  return {fine, kept(shares.middle), kept(shares.coarse), static_cast<float>(shares.depth) * fine};
}

}  // namespace relievo
