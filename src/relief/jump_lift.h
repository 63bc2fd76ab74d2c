// Keeps the front side of depth jumps in front. Equation (9) uses slopes alone, and the misfit that it leaves
// at a jump can put the front edge below the surface behind it, which looks like a crack. See
// docs/decisions/jump-lift.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

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

}  // namespace relievo
