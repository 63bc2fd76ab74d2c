// Lowers the dark parts of a coloured scan, such as pupils, inlays or painted letters. Tested by
// tests/relief/colour_lines_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/relief/relief.h"

namespace relievo {

// Returns the share of the line depth per point, in [0, 1]. The share is 1 where the scan's colours are at
// least 12 % of the range of lightness darker than their surroundings, and 0 where they are less than 4 %
// darker. The lightness of the surroundings is a Gaussian mean along the surface with a standard deviation of
// 2.5 % of the longer side, so only the edges of wide dark areas count as lines. Near the boundary the share
// fades like w_b of (7). The result is empty if the surface has no colours. Source: Winnemoeller, Kyprianidis
// and Olsen, XDoG, 2012; the second Gaussian is wider here, so that pupils are filled.
std::vector<float> dark_lines(const Surface& surface);

// Lowers the heights z by the depth of the lines, but not below the base, 0. If the highest point is on a
// line, all heights are first scaled, so that the height of the relief does not change.
template <typename Real>
void sink_lines(std::span<const float> lines, double depth, std::span<Real> z);

// Lowers the relief's heights by the line depth of its shape.
void sink_lines(const Surface& surface, Relief& relief);

}  // namespace relievo
