#include "relief/colour_lines.h"

#include <algorithm>
#include <cmath>

#include "core/height_span.h"
#include "core/srgb.h"
#include "relievo/relief/weights.h"
#include "relievo/scan/surface.h"
#include "scan/surface_blur.h"

namespace relievo {
namespace {

// Standard deviations of two Gaussians, as shares of the longer side. The narrow Gaussian removes colour
// noise; its standard deviation is at least `least_narrow_rho` sampling distances.
constexpr double narrow = .0025, wide = .025, least_narrow_rho = 1.5;
// Differences of lightness between a line and its surroundings, as shares of the range of lightness. If the
// difference is at most `least_darker`, the line does not sink. If it is at least `most_darker`, the line
// sinks by the full depth.
constexpr float least_darker = .04F, most_darker = .12F;

// Multiplies the heights z by `factor`, subtracts the depth of the lines, and writes the results to `to`. No
// result is less than the smaller one of z and 0, where 0 is the base. Returns the highest result and the
// index of its point.
template <typename Real>
std::pair<double, std::size_t> lowered(std::span<const float> lines, double depth, double factor,
                                       std::span<const Real> z, std::span<Real> to) {
  std::pair<double, std::size_t> top{0, 0};
  for (std::size_t i = 0; i < z.size(); ++i) {
    const Real deep = static_cast<Real>(depth) * static_cast<Real>(lines[i]);
    to[i] = std::max(static_cast<Real>(factor) * z[i] - deep, std::min(z[i], Real(0)));
    if (static_cast<double>(to[i]) > top.first) top = {static_cast<double>(to[i]), i};
  }
  return top;
}

}  // namespace

std::vector<float> dark_lines(const Surface& surface) {
  if (surface.colours.empty()) return {};
  std::vector<float> light;
  for (const Colour& colour : surface.colours) light.push_back(static_cast<float>(lightness(colour)));
  const double side = surface.longer_side();
  const auto near = blurred(surface.points, light, std::max(narrow * side, least_narrow_rho * surface.rho));
  const auto around = blurred(surface.points, light, wide * side);
  std::vector<float> lines = boundary_weights(surface.boundary.distance, surface.rho);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float darker = around[i] - near[i];
    const float t = std::clamp((darker - least_darker) / (most_darker - least_darker), 0.F, 1.F);
    lines[i] *= t * t * (3 - 2 * t);
  }
  return lines;
}

template <typename Real>
void sink_lines(std::span<const float> lines, double depth, std::span<Real> z) {
  if (lines.empty() || !(depth > 0)) return;
  const std::vector<Real> before(z.begin(), z.end());
  const double wanted = static_cast<double>(span_of(std::span<const Real>(before)).highest);
  // The highest height is a convex, piecewise linear function of `factor`, so Newton's method converges in a
  // few steps.
  constexpr int most_steps = 8;
  constexpr double tolerance = 1e-6;
  double factor = 1;
  for (int step = 0; step < most_steps; ++step) {
    const auto [top, i] = lowered<Real>(lines, depth, factor, before, z);
    const auto slope = static_cast<double>(before[i]);
    if (std::abs(top - wanted) <= tolerance * wanted || !(slope > 0)) return;
    factor += (wanted - top) / slope;
  }
}

template void sink_lines(std::span<const float>, double, std::span<float>);
template void sink_lines(std::span<const float>, double, std::span<double>);

void sink_lines(const Surface& surface, Relief& relief) {
  if (relief.shape.line_depth > 0)
    sink_lines<double>(dark_lines(surface), relief.shape.line_depth, relief.heights);
}

}  // namespace relievo
