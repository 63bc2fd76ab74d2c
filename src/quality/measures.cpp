#include "relievo/quality/measures.h"
#include "core/angle.h"
#include "core/quantile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quality/image_measures.h"
#include "quality/model_picture.h"
#include "quality/surface_measures.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

constexpr int lights = 16;

// Returns direction i of 16 directions of light: eight azimuths at an elevation of 30 degrees, then the same at 55
// degrees.
Vec3f light_direction(int i) {
  const double azimuth = i % 8 * std::numbers::pi / 4;
  const double elevation = to_radians(i < 8 ? 30 : 55);
  return Vec3(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
              std::sin(elevation))
      .cast<float>();
}

Image<float> lambert(const NormalMap& n, const Vec3f& light) {
  Image<float> out = filled_image(n.x.width, n.x.height, 0.F);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = std::max(0.F, n.x[i] * light.x() + n.y[i] * light.y() + n.z[i] * light.z());
  return out;
}

Image<float> product(const Image<float>& a, const Image<float>& b) {
  Image<float> out = filled_image(a.width, a.height, 0.F);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = a[i] * b[i];
  return out;
}

}  // namespace

struct ReliefMetrics::Reference : ModelPicture {
  // The shading under a light, with its local mean and variance, for SSIM.
  struct Shading {
    Image<float> mean, variance, light;
  };
  struct Edge {
    Index a, b;
  };
  // Places where the relief may have a step.
  struct Steps {
    std::vector<Edge> jumps;  // edges of triangles across depth jumps of the model
    std::vector<Index> rim;   // points next to the boundary, possibly repeated
  };

  SurfaceMeasures surface_measures;
  std::vector<Shading> shadings;
  std::vector<MaskedGaussian> smoothing;  // per detail scale
  std::array<Image<float>, 3> curvature;  // per detail scale: smoothed curvature
  Steps steps;
  GaussianFilter window{1.5, safe_distance_px};

  explicit Reference(const Surface& surface)
      : ModelPicture(surface, longer_side_px, margin_px), surface_measures(surface) {
    if (grid.pixels() == 0) return;
    shadings.resize(lights);
    parallel_for(
        lights, [&](std::size_t i) { shadings[i] = shading_of(normals, static_cast<int>(i)); }, 1);
    for (const int s : detail_scales_px) smoothing.emplace_back(detail_gaussian(s, measured));
    curvature = smoothed_curvature(normals);
    find_steps(surface);
  }

  void find_steps(const Surface& surface) {
    const std::vector<std::uint8_t>& is_boundary = surface.boundary.is_boundary;
    each_side_inside(surface, [&](Index a, Index b) {
      if (is_boundary[a] != is_boundary[b]) steps.rim.push_back(is_boundary[a] ? b : a);
      if (a < b && !is_boundary[a] && !is_boundary[b] && is_jump(surface, a, b))
        steps.jumps.push_back({a, b});
    });
  }

  Shading shading_of(const NormalMap& n, int light) const {
    Shading s;
    s.light = lambert(n, light_direction(light));
    s.mean = s.light;
    window.apply(s.mean);
    s.variance = product(s.light, s.light);
    window.apply(s.variance);
    for (std::size_t i = 0; i < s.variance.size(); ++i) s.variance[i] -= s.mean[i] * s.mean[i];
    return s;
  }

  // Returns the structural similarity (SSIM) of two shadings by Wang, Bovik, Sheikh and Simoncelli 2004, with their
  // constants and window.
  double similarity(const Shading& a, const Shading& b) const {
    constexpr double c1 = .01 * .01, c2 = .03 * .03;
    Image<float> ab = product(a.light, b.light);
    window.apply(ab);
    double sum = 0;
    for (const Index i : measured.pixels) {
      const double ma = static_cast<double>(a.mean[i]), mb = static_cast<double>(b.mean[i]);
      const double va = static_cast<double>(a.variance[i]), vb = static_cast<double>(b.variance[i]);
      const double cov = static_cast<double>(ab[i]) - ma * mb;
      sum += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
    return sum / static_cast<double>(measured.pixels.size());
  }

  double shading(const NormalMap& n) const {
    std::array<double, lights> parts{};
    parallel_for(
        lights,
        [&](std::size_t i) { parts[i] = similarity(shadings[i], shading_of(n, static_cast<int>(i))); }, 1);
    double sum = 0;
    for (const double part : parts) sum += part;
    return sum / lights;
  }

  double angle_deg(const NormalMap& n) const {
    double sum = 0;
    for (const Index i : measured.pixels) {
      const double cosine =
          static_cast<double>(n.x[i] * normals.x[i] + n.y[i] * normals.y[i] + n.z[i] * normals.z[i]);
      sum += std::acos(std::clamp(cosine, -1.0, 1.0));
    }
    return to_degrees(sum / static_cast<double>(measured.pixels.size()));
  }

  std::array<Image<float>, 3> smoothed_curvature(const NormalMap& n) const {
    std::array<Image<float>, 3> smoothed;
    smoothed.fill(divergence(n.x, n.y, measured));
    parallel_for(
        smoothed.size(), [&](std::size_t s) { smoothing[s].apply(smoothed[s], measured); }, 1);
    return smoothed;
  }

  // Sets halo, steep_share, height_used, jump_step and rim_step. Uses all pixels, not only the measured ones.
  void guard(const Image<float>& z, const NormalMap& n, std::span<const double> heights, Measures& m) const {
    const double height_px = m.height / grid.units_per_pixel();
    const float steep = static_cast<float>(std::cos(to_radians(80)));
    std::vector<float> inside;
    double background = 0, sum = 0, sum_sq = 0, steep_pixels = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (is_inside[i]) {
        inside.push_back(z[i]);
        steep_pixels += n.z[i] < steep;
        continue;
      }
      const auto value = static_cast<double>(z[i]);
      ++background, sum += value, sum_sq += value * value;
    }
    const double mean = background > 0 ? sum / background : 0;
    if (background > 0) m.halo = std::sqrt(std::max(0.0, sum_sq / background - mean * mean)) / height_px;
    const auto percentile = [&](double share) { return static_cast<double>(quantile(inside, share)); };
    m.steep_share = steep_pixels / static_cast<double>(inside.size());
    m.height_used = (percentile(.99) - percentile(.01)) / height_px;
    for (const auto& [a, b] : steps.jumps)
      m.jump_step = std::max(m.jump_step, std::abs(heights[a] - heights[b]) / m.height);
    for (const Index i : steps.rim) m.rim_step = std::max(m.rim_step, std::abs(heights[i]) / m.height);
  }
};

ReliefMetrics::ReliefMetrics(const Surface& surface) : reference_(std::make_unique<Reference>(surface)) {}
ReliefMetrics::ReliefMetrics(ReliefMetrics&&) noexcept = default;
ReliefMetrics::~ReliefMetrics() = default;

std::size_t ReliefMetrics::pixels() const {
  return reference_->measured.pixels.size();
}

double ReliefMetrics::shading(std::span<const double> heights) const {
  if (pixels() == 0) return 0;
  return reference_->shading(normals_of(reference_->heights_in_pixels(heights)));
}

Measures ReliefMetrics::measure(std::span<const double> heights) const {
  Measures m;
  if (pixels() == 0) return m;
  const auto [low, high] = std::ranges::minmax(heights);
  m.height = std::max(high, 0.0) - std::min(low, 0.0);
  if (!(m.height > 0)) return m;
  const Image<float> z = reference_->heights_in_pixels(heights);
  const NormalMap n = normals_of(z);
  m.shading = reference_->shading(n);
  m.angle_deg = reference_->angle_deg(n);
  const std::array<Image<float>, 3> curvature = reference_->smoothed_curvature(n);
  for (std::size_t s = 0; s < curvature.size(); ++s)
    m.detail[s] = correlation(curvature[s], reference_->curvature[s], reference_->measured);
  m.order = order_kept(z, reference_->depth, reference_->measured);
  m.near_order = near_order_kept(z, reference_->depth, reference_->measured);
  reference_->guard(z, n, heights, m);
  const SurfaceMeasures& triangles = reference_->surface_measures;
  const auto [silhouette, jump] = triangles.fray(heights);
  m.silhouette_fray_deg = silhouette, m.jump_fray_deg = jump;
  m.facet_angle_deg = triangles.facet_angle_deg(heights);
  m.longest_side = triangles.longest_side();
  return m;
}

}  // namespace relievo
