// Chooses, per model, how strongly the membrane compresses heights: as strongly as possible while coarse
// detail and depth order stay at least as good as with gradient-domain compression.
#pragma once

#include <array>

#include "relief/membrane/baseline_comparison.h"
#include "relievo/core/progress.h"
#include "relievo/relief/shape.h"

namespace relievo {

// The membrane's parameters over u, interpolated between four knots.
class MembraneTuning {
 public:
  // Values of u, each 2.5 times the last one.
  static constexpr std::array<double, 4> knots{.25, .625, 1.5625, 3.90625};

  // Starts with the default parameters, which remain where nothing can be measured.
  MembraneTuning();

  // Returns the parameters at u in [0, infinity]: between the knots the share and the pull, 1 /
  // pull_length^2, are linear in ln u. The share tends to 1 as u grows, and the height to which (9) is
  // compressed grows with u.
  MembraneParams at(double u) const;

  std::array<MembraneParams, knots.size()> params;
};

// Searches the parameters at the knots by bisection (for layered_shape(); reused for other shapes).
// Candidates are scored with FastMetrics; each search is calibrated with full reliefs. If nothing satisfies
// both constraints, takes the candidate with the smallest violation. The share is capped at 0.75 (for u = 0)
// unless depth order needs more; it is lowered where the height would otherwise fall as u grows. Returns the
// default if the scan is too sparse to measure. Takes 0.2 s for 180k points. Errors: kind cancelled.
Result<MembraneTuning> tune_membrane(const TuningInput& input, const Progress* progress = nullptr);

}  // namespace relievo
