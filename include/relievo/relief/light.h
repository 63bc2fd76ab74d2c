// Defines the parameters of a relief that is made for one light, such as a lamp over a plaque.
#pragma once

#include <string_view>

#include "relievo/core/error.h"

namespace relievo {

// The direction of the light in degrees. The azimuth is in the plate's plane, in [-360, 360]: 0 is from the
// right, 90 from above, 135 from the upper left. The elevation is the angle above the plane, in [5, 85].
struct LightDirection {
  double azimuth_deg = 135, elevation_deg = 30;

  bool operator==(const LightDirection&) const = default;
};

// Parameters of a relief for one light. The slopes along the light's azimuth are chosen so that the relief's
// shading is the sum of two parts: the shading of the level plate, and `contrast` times the model's local
// contrast of shading. Slopes across the azimuth do not change.
struct ReliefLight {
  LightDirection from;
  double contrast = .8;  // [0, 1]; with 0 the model's shading is ignored

  bool operator==(const ReliefLight&) const = default;
};

// Parses "AZIMUTH,ELEVATION" in degrees. Errors: kind option.
Result<LightDirection> parse_light(std::string_view text);

}  // namespace relievo
