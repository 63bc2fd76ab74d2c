// Compares layered reliefs of a model with gradient-domain compression of the same height.
#pragma once

#include <span>
#include <vector>

#include "quality/fast_metrics.h"
#include "relief/jump_lift.h"
#include "relief/membrane/height_correction.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/layers.h"
#include "relievo/scan/surface.h"

namespace relievo {

// The parts of a model that the membrane is tuned with. `system` is that of all points.
struct TuningInput {
  const Surface& surface;
  std::span<const PointLayers> layers;
  const HeightCorrection& correction;
  const HeightSystem& system;
  const JumpLift& jump_lift;
};

// Keeps views of its input, which must outlive it. Const calls may run concurrently.
class BaselineComparison {
 public:
  explicit BaselineComparison(const TuningInput& input);

  // Returns whether there are enough pixels to measure, and anything to compress.
  bool is_measurable() const;

  const FastMetrics& metrics() const { return metrics_; }
  const HeightCorrection& correction() const { return input_.correction; }

  // Returns the heights that (9) gives layered_shape() at u, before compression; in single precision.
  std::vector<double> heights(double u, const MembraneParams& params) const;

  // Returns the baseline's scores minus those of these heights, compressed, both at the same final height:
  // positive where the baseline's are better.
  Scores deficit(std::vector<double> heights, const MembraneParams& params) const;

 private:
  std::vector<double> solved(std::span<const Vec2> slopes) const;

  TuningInput input_;
  FastMetrics metrics_;
  std::vector<float> boundary_weight_;
  std::vector<double> baseline_;  // heights of gradient-domain compression, unscaled
  double baseline_span_;
};

}  // namespace relievo
