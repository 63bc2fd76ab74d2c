#include "relievo/relief/attention.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "relievo/core/parallel.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

// Standard deviations of the narrower Gaussian, as shares of the longer side. Lee et al. take 2 to 6 times
// 0.3 % of the diagonal of the model's box. This diagonal is about 1.3 times as long as the longer side. The
// wider Gaussian has twice the width.
constexpr std::array widths{.008, .012, .016, .02, .024};
// Standard deviations, as shares of the longer side. `prior_width` is that of the prior, a Gaussian around the middle
// of the view; `smoothing` is that of the last blur of the attention. Slopes that are scaled by a less smooth field
// would not fit any surface.
constexpr double prior_width = .35, smoothing = .02;

// Returns the mean of all local maxima except those equal to `highest`; 0 if there are none.
double mean_of_other_maxima(const Surface& surface, std::span<const float> values, float highest) {
  std::vector<std::uint8_t> is_exceeded(values.size(), 0);
  for (const Triangle& corners : surface.triangulation.triangles)
    for (std::size_t side = 0; side < 3; ++side) {
      const Index a = corners[side], b = corners[(side + 1) % 3];
      if (values[a] != values[b]) is_exceeded[values[a] < values[b] ? a : b] = 1;
    }
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_exceeded[i] || values[i] == highest) continue;
    sum += static_cast<double>(values[i]), ++count;
  }
  return count > 0 ? sum / count : 0;
}

// Adds the absolute differences between two Gaussian means of the curvature. The differences are divided by their
// maximum. Then they are multiplied by (1 - m)^2, where m is the mean of the local maxima below 1 (the suppression S of
// Lee et al.).
void add_differences(const Surface& surface, double width, std::span<float> sums) {
  const auto blurred_by = [&](double share) {
    return blurred(surface.points, surface.curvature.k, share * surface.longer_side());
  };
  const std::vector<float> near = blurred_by(width), around = blurred_by(2 * width);
  std::vector<float> apart(near.size());
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i] = std::abs(near[i] - around[i]);
  const float highest = std::ranges::max(apart);
  if (!(highest > 0)) return;
  const auto lacking =
      static_cast<float>(1 - mean_of_other_maxima(surface, apart, highest) / static_cast<double>(highest));
  for (std::size_t i = 0; i < apart.size(); ++i) sums[i] += lacking * lacking * apart[i] / highest;
}

void multiply_by_prior(const Surface& surface, std::span<float> values) {
  const Vec2 middle = Box::of(surface.points).centre().head<2>();
  const double width = prior_width * surface.longer_side();
  parallel_for(values.size(), [&](std::size_t i) {
    const double away = (surface.points[i].head<2>() - middle).norm() / width;
    values[i] *= static_cast<float>(std::exp(-away * away / 2));
  });
}

}  // namespace

std::vector<float> attention(const Surface& surface) {
  std::vector<float> values(surface.points.size(), 0);
  if (values.empty() || !(surface.longer_side() > 0)) return values;
  for (const double width : widths) add_differences(surface, width, values);
  multiply_by_prior(surface, values);
  values = blurred(surface.points, values, smoothing * surface.longer_side());
  const auto [least, most] = std::ranges::minmax(values);
  const float range = most - least;
  for (float& value : values) value = range > 0 ? std::clamp((value - least) / range, 0.F, 1.F) : 0;
  return values;
}

std::vector<std::uint16_t> levels_of(const std::vector<float>& attention) {
  const double mean = std::accumulate(attention.begin(), attention.end(), 0.) /
                      std::max(1., static_cast<double>(attention.size()));
  std::vector<std::uint16_t> levels;
  for (const float value : attention)
    levels.push_back(
        static_cast<std::uint16_t>(std::lround((static_cast<double>(value) - mean + 1) * attention_steps)));
  return levels;
}

}  // namespace relievo
