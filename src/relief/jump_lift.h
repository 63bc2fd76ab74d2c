// Keeps the front side of each depth jump in front, and computes the heights of depth jumps. Equation (9)
// uses only slopes. The misfit that it leaves at a jump can put the front edge below the surface behind it,
// which looks like a crack: the jump is inverted. See docs/decisions/jump-lift.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/height_span.h"
#include "relievo/core/parallel.h"
#include "relievo/core/types.h"
#include "relievo/relief/layers.h"
#include "relievo/relief/shape.h"

namespace relievo {

class HeightSystem;
struct Surface;

// `system` is the system of all points.
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

  // Finds fields that put right nearly all inverted jumps. They do not change the heights on the silhouette.
  static JumpLift find(const JumpLiftInput& input);

  // Adds the field for a layered shape to z, which has the height from (9) of each point for that shape. The
  // shape's membrane must be set. Changes nothing if the height correction is switched off, so that level
  // parts stay level.
  template <typename Real>
  void add_to(std::span<Real> z, const Shape& shape) const {
    const Eigen::Array4f shares = shares_at(shape);
    if ((shares == 0).all()) return;
    parallel_for(points_.size(),
                 [&](std::size_t i) { z[points_[i]] += static_cast<Real>((shares * fields_[i]).sum()); });
  }

  std::size_t memory() const;

 private:
  // Returns the factors of the knots' fields for a shape.
  Eigen::Array4f shares_at(const Shape& shape) const;

  std::vector<Index> points_;           // the points that move
  std::vector<Eigen::Array4f> fields_;  // field of each of these points, for each knot
};

// The heights of depth jumps, in units of the surface. Equation (9) uses only slopes, so a form that consists
// of steps, such as letters on a plate, would vanish. The relief of such a form gets these heights in
// addition.
struct StepHeights {
  std::vector<float> z;  // per point, 0 at the boundary; empty if the surface has no depth jump
  double span = 0;       // highest minus lowest; 0 counts as a height

  bool empty() const { return z.empty(); }
};

// Returns the least-squares solution of (9) for given height differences along the edges. Across a depth jump
// the difference is the part of the depth difference that the slopes do not explain; along all other edges it
// is 0. `weights` are the weights of the system.
StepHeights find_step_heights(const Surface& surface, std::span<const float> weights,
                              const HeightSystem& system);

// Adds the step heights to the heights z that slopes give, so that the steps take `share` of the height.
// `height` is the height of the relief before its style compresses it. If it is not given, the slopes
// determine the height, and the share must be below 1.
template <typename Real>
void add_steps(const StepHeights& steps, double share, std::optional<double> height, std::span<Real> z) {
  if (steps.empty() || share == 0) return;
  if (!height) height = static_cast<double>(span_of(std::span<const Real>(z)).size()) / (1 - share);
  const auto factor = static_cast<Real>(share * *height / steps.span);
  parallel_for(z.size(), [&](std::size_t i) { z[i] += factor * static_cast<Real>(steps.z[i]); });
}

// Prepares a shape for a search of step_share(), if slopes alone do not reach the height. The slopes stay
// uncompressed. Then nothing has to be compressed, so the height correction is turned off, and level parts
// stay level.
inline void keep_slopes(Shape& shape) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  shape.compression.u = infinity;
  shape.membrane = MembraneParams{1, infinity};
}

// Returns the share of the height for the depth jumps, as a function of x. HeightSearch varies x like ln u
// until slopes and jumps together reach the height. At x = -infinity the share is 0; at x = infinity the
// jumps are as deep as in the model.
inline double step_share(const StepHeights& steps, double height, double x) {
  return steps.span / height / (1 + std::exp(-x));
}

}  // namespace relievo
