// Samples of the share of a slope that a relief keeps, over curvature. The page draws them as the tone curve.
#pragma once

#include <vector>

#include "relievo/relief/weights.h"

namespace relievo::app::studio {

// Samples in [0, 1] at sqrt(|k|) = i / (size - 1).
struct CurveSamples {
  static constexpr std::size_t size = 81;

  std::vector<double> share;  // that saturation or tone curve ask for
  std::vector<double> kept;   // in the relief of this height; in layers the same as `share`
};

// Returns the samples for a shape; delta is that of the model's curvature, see NormalisedCurvature.
CurveSamples sample_curve(const Shape& shape, double delta);

}  // namespace relievo::app::studio
