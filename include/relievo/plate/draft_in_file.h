// Measures and limits the slopes of a solid as files store it, with coordinates rounded to single precision.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Returns the steepest slope (tangent) of the front's triangles, with the corners rounded to single
// precision, because files store them so. The result is infinite if a triangle is vertical or overhangs,
// unless its corners have the same height.
double steepest_slope(const Solid& solid);

// Moves points of the solid's front up or down, only as much as rounding to single precision requires, until
// no front triangle in a file exceeds the limit. Returns the largest move in mm, usually below 1e-5. The
// ground, the highest and the lowest point do not move. Errors: kind geometry if no such moves are found; the
// solid is then unchanged. In that case the front was already too steep, or rounding made a triangle too
// steep that cannot be mended, because its points are fixed or only a few units in the last place apart.
Result<double> enforce_draft_in_float(Solid& solid, double max_slope);

}  // namespace relievo
