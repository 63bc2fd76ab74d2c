#include "quick_judge.h"

#include "relievo/measures.h"

namespace relievo {
namespace {

// Differences between neighbours smooth twice as much as in Judge's picture, so that the Gaussian is narrower
// than 2.
constexpr double sigma_px = 1.87;
constexpr int reach_px = 6;
constexpr std::size_t pairs = 20000;

// Calls f(pixel, the first of the four it is made of), row by row.
template <typename F>
void each_half(const PictureGrid& grid, F&& f) {
  const int width = grid.width() / 2;
  for (int y = 0; y < grid.height() / 2; ++y)
    for (int x = 0; x < width; ++x)
      f(static_cast<std::size_t>(y * width + x), static_cast<std::size_t>(2 * (y * grid.width() + x)));
}

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

}  // namespace

QuickJudge::QuickJudge(const Surface& surface)
    : picture_(surface, Judge::longer_side_px, Judge::margin_px),
      where_(half_measured(picture_)),
      smoothing_(sigma_px, reach_px, where_),
      depth_(halved(picture_.depth)) {
  const NormalPicture& n = picture_.normals;
  curvature_ = smoothed_curvature({halved(n.x), halved(n.y), {}});
}

Plane QuickJudge::halved(const Plane& fine) const {
  Plane half(where_.is_measured.size());
  const auto row = static_cast<std::size_t>(picture_.width());
  each_half(picture_.grid, [&](std::size_t i, std::size_t first) {
    const float* v = &fine[first];
    half[i] = (v[0] + v[1] + v[row] + v[row + 1]) / 4;
  });
  return half;
}

// Heights are in pixels twice as wide.
Plane QuickJudge::draw(std::span<const double> heights) const {
  Plane half = halved(picture_.heights_in_pixels(heights));
  for (float& z : half) z /= 2;
  return half;
}

// Two of the four, across.
Plane QuickJudge::draw_smooth(std::span<const float> heights) const {
  Plane half(where_.is_measured.size());
  const PictureGrid& grid = picture_.grid;
  const auto across = static_cast<std::size_t>(grid.width()) + 1;
  const auto scale = static_cast<float>(1 / (4 * grid.units_per_pixel()));
  const auto height = [&](Index p) { return heights[p]; };
  each_half(grid, [&](std::size_t i, std::size_t first) {
    half[i] = scale * (grid.at(first, height, 0) + grid.at(first + across, height, 0));
  });
  return half;
}

Plane QuickJudge::smoothed_curvature(const NormalPicture& n) const {
  Plane sum = divergence(n.x, n.y, where_);
  smoothing_.apply(sum, where_);
  return sum;
}

double QuickJudge::detail(const Plane& z) const {
  return correlation(smoothed_curvature(normals_of(z, where_.width)), curvature_, where_);
}

double QuickJudge::order(const Plane& z) const {
  return order_kept(z, depth_, where_, pairs);
}

}  // namespace relievo
