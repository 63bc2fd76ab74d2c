#include "quality/fast_metrics.h"

#include "relievo/quality/measures.h"

namespace relievo {
namespace {

// Central differences at half the resolution smooth twice as much, so the Gaussian is a little narrower than the 2
// pixels that 4 pixels of the full picture would be.
constexpr double sigma_px = 1.87;
constexpr int radius_px = 6;
// A tenth of the pairs of ReliefMetrics: the order is then within 0.005 of the exact one.
constexpr std::size_t fewer_pairs = 20000;

Measured half_measured(const ModelPicture& picture) {
  const auto row = static_cast<std::size_t>(picture.width());
  const int width = picture.width() / 2, height = picture.grid.height() / 2;
  std::vector<std::uint8_t> measured(static_cast<std::size_t>(width * height));
  each_half(picture.grid, [&](std::size_t i, std::size_t first) {
    const std::uint8_t* m = &picture.measured.is_measured[first];
    measured[i] = m[0] && m[1] && m[row] && m[row + 1];
  });
  return {width, std::move(measured)};
}

Plane smoothed_curvature(const NormalPicture& n, const MeasuredGaussian& smoothing, const Measured& where) {
  Plane sum = divergence(n.x, n.y, where);
  smoothing.apply(sum, where);
  return sum;
}

}  // namespace

FastMetrics::FastMetrics(const Surface& surface)
    : picture_(surface, ReliefMetrics::longer_side_px, ReliefMetrics::margin_px),
      where_(half_measured(picture_)),
      smoothing_(sigma_px, radius_px, where_),
      exact_smoothing_(detail_gaussian(detail_scales_px.back(), picture_.measured)),
      depth_(halved(picture_.depth)) {
  const NormalPicture& n = picture_.normals;
  curvature_ = smoothed_curvature({halved(n.x), halved(n.y), {}}, smoothing_, where_);
  exact_curvature_ = smoothed_curvature(n, exact_smoothing_, picture_.measured);
}

Plane FastMetrics::halved(const Plane& fine) const {
  Plane half(where_.is_measured.size());
  const auto row = static_cast<std::size_t>(picture_.width());
  each_half(picture_.grid, [&](std::size_t i, std::size_t first) {
    const float* v = &fine[first];
    half[i] = (v[0] + v[1] + v[row] + v[row + 1]) / 4;
  });
  return half;
}

// Heights are in pixels twice as wide.
Plane FastMetrics::draw(std::span<const double> heights) const {
  Plane half = halved(picture_.heights_in_pixels(heights));
  for (float& z : half) z /= 2;
  return half;
}

Scores FastMetrics::estimate(const Plane& z) const {
  const Plane curvature = smoothed_curvature(normals_of(z, where_.width), smoothing_, where_);
  return {correlation(curvature, curvature_, where_), order_kept(z, depth_, where_, fewer_pairs)};
}

Scores FastMetrics::exact_scores(std::span<const double> heights) const {
  const Plane z = picture_.heights_in_pixels(heights);
  const Measured& measured = picture_.measured;
  const Plane curvature = smoothed_curvature(normals_of(z, picture_.width()), exact_smoothing_, measured);
  return {correlation(curvature, exact_curvature_, measured),
          order_kept(z, picture_.depth, measured, order_pairs)};
}

}  // namespace relievo
