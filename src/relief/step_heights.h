// Computes the heights of steps at depth jumps. Equation (9) uses only slopes, so without these steps depth
// jumps vanish. See docs/decisions/steps.md and docs/decisions/near-order.md.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/height_span.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/shape.h"

namespace relievo {

class HeightSystem;
struct Surface;

// Heights that have steps at the depth jumps of a surface.
struct StepHeights {
  std::vector<float> z;  // per point, 0 at the boundary; empty if the surface has no depth jump
  double span = 0;       // highest minus lowest height; the base, 0, counts as a height

  bool empty() const { return z.empty(); }
};

// The least-squares solutions of equation (9) for given height differences along the edges.
struct StepFields {
  // Across a depth jump, the given height difference is the part of the depth difference that the slopes do
  // not explain. Along all other edges it is 0. These heights keep forms that consist of steps, such as
  // letters on a plate.
  StepHeights steps;
  // Across a wall, the given height difference is tanh(d / (0.05 side)), where side is the longer side. Along
  // all other edges it is 0. Positions and normals are averaged on both sides of the wall over about two
  // sampling distances. d is the part of the difference in mean depth that slopes do not explain. So these
  // steps are 1 high at deep jumps, and fade out at the ends of a jump. They raise each part above the
  // surface behind it.
  StepHeights planes;

  // `system` is the system of all points of the surface.
  static StepFields find(const Surface& surface, const HeightSystem& system);
};

// Adds the planes to the heights z of a layered shape, so that a deep jump rises by about Shape::planes of the relief's
// height. Does nothing if the shape has no height correction, because level parts must then stay level.
template <typename Real>
void add_planes(const StepHeights& planes, const Shape& shape, std::span<Real> z) {
  if (planes.empty() || shape.style != Style::layered || !shape.is_corrected || shape.planes == 0) return;
  const double height = height_share(shape) * static_cast<double>(span_of(std::span<const Real>(z)).size());
  const auto step = static_cast<Real>(shape.planes * height);
  parallel_for(z.size(), [&](std::size_t i) { z[i] += step * static_cast<Real>(planes.z[i]); });
}

// Adds the step heights to the heights z that slopes give, so that the steps take `share` of the height.
// `height` is the relief's height before its style compresses it. If no height is given, it follows from the
// slopes and the share, which must be below 1.
template <typename Real>
void add_steps(const StepHeights& steps, double share, std::optional<double> height, std::span<Real> z) {
  if (steps.empty() || share == 0) return;
  if (!height) height = static_cast<double>(span_of(std::span<const Real>(z)).size()) / (1 - share);
  const auto factor = static_cast<Real>(share * *height / steps.span);
  parallel_for(z.size(), [&](std::size_t i) { z[i] += factor * static_cast<Real>(steps.z[i]); });
}

// Prepares a shape for a search with step_share(), if slopes alone do not reach the height. Turns the height
// correction off, for two reasons: uncompressed slopes do not need it, and level parts would not stay level
// with it.
inline void keep_slopes(Shape& shape) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  shape.compression.u = infinity;
  shape.height_share = 1;
  shape.is_corrected = false;
}

// Returns the share of the height that depth jumps get, as a function of x. At x = -infinity the share is
// 0. At x = infinity the jumps are as deep as in the model. HeightSearch varies x instead of ln u, until
// slopes and jumps together reach the height.
inline double step_share(const StepHeights& steps, double height, double x) {
  return steps.span / height / (1 + std::exp(-x));
}

}  // namespace relievo
