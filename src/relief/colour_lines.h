// Lowers the dark parts of a coloured scan, such as pupils, inlays or painted letters.
#pragma once

#include <span>
#include <vector>

#include "relievo/relief/relief.h"

namespace relievo {

// Returns for each point how far it sinks as part of a dark line, as a share of the depth of lines, in [0, 1]. A point
// is compared with its surroundings: a Gaussian mean of the lightness along the surface, with a standard deviation of
// 2.5 % of the longer side. So only the edges of wide dark areas count as lines. The share is 1 if the point is darker
// than this mean by at least 12 % of the range of lightness. It is 0 if the difference is below 4 %. Near the boundary
// it fades like the paper's weight w_b of equation (7). The result is empty if the surface has no colours. Source:
// Winnemoeller, Kyprianidis and Olsen, XDoG, 2012; the second Gaussian is wider here, so that pupils are filled.
std::vector<float> dark_lines(const Surface& surface);

// Lowers the heights z by the depth of the lines, but not below the base, 0. If the highest point is on a
// line, all heights are first scaled, so that the height of the relief does not change.
template <typename Real>
void sink_lines(std::span<const float> lines, double depth, std::span<Real> z);

// Does the same with the heights of `relief`. The depth of the lines is the line depth of its shape.
void sink_lines(const Surface& surface, Relief& relief);

}  // namespace relievo
