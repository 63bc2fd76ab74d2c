// Keeps what is in front in front at depth jumps, and finds their heights. Equation (9) sees slopes alone, and the
// misfit that it leaves at a jump can put the front edge below the surface behind it, which looks like a crack.
// docs/decisions/jump-lift.md
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "relief/height_span.h"
#include "relievo/core/parallel.h"
#include "relievo/core/types.h"
#include "relievo/relief/layers.h"
#include "relievo/relief/shape.h"

namespace relievo {

class HeightSystem;
struct Surface;

// `system` is that of all points.
struct JumpLiftInput {
  const Surface& surface;
  std::span<const PointLayers> layers;
  const HeightSystem& system;
};

// Smooth fields that raise the front side of inverted jumps and lower the back side, and fade out beside
// them.
class JumpLift {
 public:
  // Fields are computed for layered shapes with these values of u, each 4 times the last one.
  static constexpr std::array<double, 4> knots{.25, 1, 4, 16};

  // Constructs a lift without fields: add_to() changes nothing.
  JumpLift() = default;

  // Finds fields with which hardly any jump is inverted. Silhouettes do not move.
  static JumpLift find(const JumpLiftInput& input);

  // Adds the field for a layered shape, whose membrane is set, to its heights from (9), one for each point of
  // the surface. Changes nothing if the height correction does not act, so that level parts stay level.
  template <typename Real>
  void add_to(std::span<Real> z, const Shape& shape) const {
    const Eigen::Array4f shares = shares_at(shape);
    if ((shares == 0).all()) return;
    parallel_for(points_.size(),
                 [&](std::size_t i) { z[points_[i]] += static_cast<Real>((shares * fields_[i]).sum()); });
  }

  std::size_t memory() const;

 private:
  // Returns how much of the field of each knot a shape gets.
  Eigen::Array4f shares_at(const Shape& shape) const;

  std::vector<Index> points_;           // the points that move
  std::vector<Eigen::Array4f> fields_;  // field of each of these points, for each knot
};

// The heights of depth jumps, in units of the surface; without a depth jump there are none. Equation (9) sees slopes
// alone, so a form that lies in steps, such as letters on a plate, would vanish. The relief of such a form takes these
// heights in addition.
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
