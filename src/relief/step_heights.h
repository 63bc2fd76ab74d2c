// The heights of depth jumps. Equation (9) sees slopes alone, so a form that lies in steps, such as letters on a
// plate, would vanish. The relief of such a form takes these heights in addition.
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

// In units of the surface; without a depth jump there are none.
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

// Adds the step heights to those of slopes, so that the steps take `share` of the height. `height` is what the relief
// has before its style compresses it, or nothing if the slopes are to decide it; the share is below 1 then.
template <typename Real>
void add_steps(const StepHeights& steps, double share, std::optional<double> height, std::span<Real> z) {
  if (steps.empty() || share == 0) return;
  if (!height) height = static_cast<double>(span_of(std::span<const Real>(z)).size()) / (1 - share);
  const auto factor = static_cast<Real>(share * *height / steps.span);
  parallel_for(z.size(), [&](std::size_t i) { z[i] += factor * static_cast<Real>(steps.z[i]); });
}

// Prepares a shape whose slopes do not reach the height for a search of the share of its steps: slopes are kept whole, and
// as nothing has to be compressed, the height correction does not act, so that level parts stay level.
inline void keep_slopes(Shape& shape) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  shape.compression.u = infinity;
  shape.membrane = MembraneParams{1, infinity};
}

// Returns the share of the height that depth jumps have to take so that slopes and jumps together reach it, as a function
// of a variable that HeightSearch may vary like ln u: 0 at -infinity; at infinity the jumps are as deep as in the model.
inline double step_share(const StepHeights& steps, double height, double x) {
  return steps.span / height / (1 + std::exp(-x));
}

}  // namespace relievo
