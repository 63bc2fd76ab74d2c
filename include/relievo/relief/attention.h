// Estimates which parts of a model viewers look at, from its curvature. Tested by
// tests/relief/attention_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns the attention of every point, in [0, 1]; 0 everywhere on a surface without curvature. The curvature
// is blurred along the surface by Gaussians of several widths. At each of five widths, the difference of two
// blurs is taken. A difference with few strong maxima gets a large weight (Lee, Varshney and Jacobs, Mesh
// saliency, 2005). The weighted sum of the differences is multiplied by a Gaussian around the middle of the
// view, smoothed, and scaled to [0, 1]. Models of this kind predict only poorly where people look, see
// docs/method.md.
std::vector<float> attention(const Surface& surface);

// A level encodes the attention minus its mean: level 0 is -1, and each level is 1 / attention_steps more
// than the previous one.
inline constexpr int attention_steps = 256, attention_levels = 2 * attention_steps + 1;

// Returns the level of each value of an attention.
std::vector<std::uint16_t> levels_of(const std::vector<float>& attention);

// Returns the value that a level encodes: the attention minus its mean, in [-1, 1].
inline double attention_at(int level) {
  return static_cast<double>(level) / attention_steps - 1;
}

}  // namespace relievo
