// Estimates which parts of a model viewers look at, from its curvature. Tested by tests/relief/attention_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns the attention of every point, in [0, 1]; 0 everywhere on a surface without curvature. Differences of two
// Gaussian means of the curvature, along the surface and at five widths, are weighted so that widths with few strong
// maxima count most (Lee, Varshney and Jacobs, Mesh saliency, 2005). Their sum is multiplied by a Gaussian around the
// middle of the view, smoothed, and scaled. Such models predict poorly where people look, see docs/method.md.
std::vector<float> attention(const Surface& surface);

// Levels are the attention minus its mean, in steps of 1 / attention_steps; level 0 is -1.
inline constexpr int attention_steps = 256, attention_levels = 2 * attention_steps + 1;

// Returns the level of every value of an attention.
std::vector<std::uint16_t> levels_of(const std::vector<float>& attention);

// Returns the attention minus its mean at a level, in [-1, 1].
inline double attention_at(int level) {
  return static_cast<double>(level) / attention_steps - 1;
}

}  // namespace relievo
