// Sinks what is dark in a coloured scan: pupils, inlays, painted letters. Tested by tests/relief/colour_lines_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/relief/relief.h"

namespace relievo {

// Returns, per point, how much of the depth of lines it gets, in [0, 1]: 1 where the scan's colours are at least 12 %
// of lightness darker than around them, 0 where they are less than 4 % darker. Around means a Gaussian of 2.5 % of the
// longer side along the surface, so that wide dark areas are lines at their edges alone. Lines fade towards the base as
// w_b of (7) does. Empty if the surface has no colours. After Winnemoeller, Kyprianidis and Olsen, XDoG, 2012, with a
// wider second Gaussian, so that pupils are filled.
std::vector<float> dark_lines(const Surface& surface);

// Lowers the heights z by the depth of the lines, but not below the base, 0. The relief keeps its height: if its
// highest point is on a line, all heights are scaled before.
template <typename Real>
void sink_lines(std::span<const float> lines, double depth, std::span<Real> z);

// Sinks the lines of the relief's shape.
void sink_lines(const Surface& surface, Relief& relief);

}  // namespace relievo
