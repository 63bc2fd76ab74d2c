// The heights of depth jumps. Equation (9) uses slopes alone, so a form that lies in steps, such as letters
// on a plate, would vanish. The relief of such a form takes these heights in addition.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "relief/height_span.h"
#include "relievo/core/parallel.h"
#include "relievo/core/types.h"
#include "relievo/relief/shape.h"

namespace relievo {

class HeightSystem;
struct Surface;

// The step heights in units of the surface; empty without a depth jump.
struct StepHeights {
  std::vector<float> z;  // per point; 0 at the boundary
  double span = 0;       // highest minus lowest; 0 counts as a height

  bool empty() const { return z.empty(); }
};

// Returns the least-squares solution of (9) for given height differences along the edges: across a depth
// jump, the part of the depth difference that the slopes do not explain; along all other edges, 0. `weights`
// are those of the system.
StepHeights find_step_heights(const Surface& surface, std::span<const float> weights,
                              const HeightSystem& system);

// Adds the step heights to those of slopes, so that the steps take `share` of the height. `height` is the
// height of the relief before its style compresses it. Without it the slopes determine the height; the share
// must then be below 1.
template <typename Real>
void add_steps(const StepHeights& steps, double share, std::optional<double> height, std::span<Real> z) {
  if (steps.empty() || share == 0) return;
  if (!height) height = static_cast<double>(span_of(std::span<const Real>(z)).size()) / (1 - share);
  const auto factor = static_cast<Real>(share * *height / steps.span);
  parallel_for(z.size(), [&](std::size_t i) { z[i] += factor * static_cast<Real>(steps.z[i]); });
}

// Prepares a shape for a search of the share of its steps, where slopes alone do not reach the height. Slopes
// are kept whole. Then nothing has to be compressed, so the height correction is turned off, and level parts
// stay level.
inline void keep_slopes(Shape& shape) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  shape.compression.u = infinity;
  shape.membrane = MembraneParams{1, infinity};
}

// Returns a share of the height for the depth jumps, as a function of x. HeightSearch varies x like ln u
// until slopes and jumps together reach the height. The share is 0 at -infinity; at infinity the jumps are as
// deep as in the model.
inline double step_share(const StepHeights& steps, double height, double x) {
  return steps.span / height / (1 + std::exp(-x));
}

}  // namespace relievo
