// Chooses, per model, how strongly the membrane compresses heights: as strongly as possible while coarse
// detail and depth order stay at least as good as with gradient-domain compression.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "quality/fast_metrics.h"
#include "relief/jump_lift.h"
#include "relief/membrane/height_correction.h"
#include "relievo/core/progress.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/layers.h"
#include "relievo/relief/shape.h"
#include "relievo/scan/surface.h"

namespace relievo {

// The parts of a model that are needed to tune the membrane. `system` is the system of all points.
struct TuningInput {
  const Surface& surface;
  std::span<const PointLayers> layers;
  const HeightCorrection& correction;
  const HeightSystem& system;
  const JumpLift& jump_lift;
};

// Compares compressed heights with gradient-domain compression, the baseline. Keeps views of its input, which
// must outlive it. Const calls may run concurrently.
class BaselineComparison {
 public:
  explicit BaselineComparison(const TuningInput& input);

  // Returns whether there are enough pixels to measure, and heights to compress.
  bool is_measurable() const;

  const FastMetrics& metrics() const { return metrics_; }
  const HeightCorrection& correction() const { return input_.correction; }

  // Returns the heights that (9) gives layered_shape() at u, before compression; in single precision.
  std::vector<double> heights(double u, const MembraneParams& params) const;

  // Returns the baseline's scores minus the scores of these heights after compression, both at the same final
  // height. The result is positive where the baseline is better.
  Scores deficit(std::vector<double> heights, const MembraneParams& params) const;

 private:
  std::vector<double> solved(std::span<const Vec2> slopes) const;

  TuningInput input_;
  FastMetrics metrics_;
  std::vector<float> boundary_weight_;
  std::vector<double> baseline_;  // heights of gradient-domain compression, unscaled
  double baseline_span_;
};

// The membrane's parameters over u, interpolated between four knots.
class MembraneTuning {
 public:
  // Values of u, each 2.5 times the last one.
  static constexpr std::array<double, 4> knots{.25, .625, 1.5625, 3.90625};

  // Starts with the default parameters, which remain if nothing can be measured.
  MembraneTuning();

  // Returns the parameters at u in [0, infinity]. Between the knots, the height share and 1 / pull_length^2
  // are linear in ln u. The share tends to 1 as u grows, and the height to which the heights of (9) are
  // compressed grows with u.
  MembraneParams at(double u) const;

  std::array<MembraneParams, knots.size()> params;
};

// Searches the parameters at the knots by bisection, for layered_shape(); other shapes use the same
// parameters. Candidates are scored with FastMetrics; each search is calibrated with full reliefs. If nothing
// satisfies both constraints, takes the candidate with the smallest violation. The height share is at most
// 0.75 (for u = 0) unless depth order needs more. It is lowered where the height would otherwise fall as u
// grows. Returns the default if the scan is too sparse to measure. Takes 0.2 s for 180k points. Errors: kind
// cancelled.
Result<MembraneTuning> tune_membrane(const TuningInput& input, const Progress* progress = nullptr);

}  // namespace relievo
