// A relief that is made for one light, such as a lamp over a plaque.
#pragma once

#include <string_view>

#include "relievo/core/error.h"

namespace relievo {

// The direction of the light, in degrees: azimuth in the plate's plane, 0 from the right, 90 from above and 135 from the
// upper left, [-360, 360]; elevation over the plane, [5, 85].
struct LightDirection {
  double azimuth_deg = 135, elevation_deg = 30;

  bool operator==(const LightDirection&) const = default;
};

// Slopes along the light's azimuth are chosen so that the relief's shading under it is that of the plate plus `contrast`
// times the local contrast of the model's shading under it; slopes across the azimuth stay.
struct ReliefLight {
  LightDirection from;
  double contrast = .8;  // [0, 1]; 0 is a relief for no light in particular

  bool operator==(const ReliefLight&) const = default;
};

// Parses "AZIMUTH,ELEVATION" in degrees. Errors: kind option.
Result<LightDirection> parse_light(std::string_view text);

}  // namespace relievo
