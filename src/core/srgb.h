// The brightness of sRGB colours. Tested by tests/core/srgb_test.cpp.
#pragma once

#include <cmath>

#include "relievo/core/types.h"

namespace relievo {

// Returns the relative luminance in [0, 1] (IEC 61966-2-1, Rec. 709 weights).
inline double luminance(const Colour& colour) {
  const auto linear = [](std::uint8_t value) {
    const double v = value / 255.0;
    return v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4);
  };
  return .2126 * linear(colour[0]) + .7152 * linear(colour[1]) + .0722 * linear(colour[2]);
}

// Returns the lightness L* of CIE 1976, divided by 100: in [0, 1], and perceptually uniform.
inline double lightness(const Colour& colour) {
  const double y = luminance(colour);
  return y > 216.0 / 24389 ? 1.16 * std::cbrt(y) - .16 : y * 24389 / 2700;
}

}  // namespace relievo
