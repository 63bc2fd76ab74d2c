// Computes the brightness and the means of sRGB colours.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

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

// Returns the mean of the colours of a triangle's corners with these weights, whose sum is 1.
inline Colour weighted_mean(std::span<const Colour> colours, const Triangle& corners, const Vec3f& weights) {
  Colour mean;
  for (std::size_t c = 0; c < 3; ++c) {
    float sum = .5F;
    for (std::size_t i = 0; i < 3; ++i) sum += weights[i] * static_cast<float>(colours[corners[i]][c]);
    mean[c] = static_cast<std::uint8_t>(std::clamp(sum, 0.F, 255.F));
  }
  return mean;
}

}  // namespace relievo
