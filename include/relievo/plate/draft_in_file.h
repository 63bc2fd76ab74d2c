// Measures and limits the slopes of a solid as files store it, with coordinates rounded to single precision.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Returns the steepest slope (tangent) of the front's triangles. The corners are first rounded to single
// precision, because files store them in single precision. The result is infinite if a triangle is vertical
// or overhangs, unless its corners have the same height.
double steepest_slope(const Solid& solid);

// Moves points of the solid's front up or down until no front triangle is steeper than `max_slope` after its
// corners are rounded to single precision. The moves are only as large as this rounding requires. Returns the
// largest move in mm, usually below 1e-5. The ground, the highest and the lowest point do not move. Errors:
// kind geometry if no such moves are found; the solid is then unchanged. There are two causes. The front may
// have been too steep before rounding. Or rounding makes a triangle too steep, and the points of this
// triangle are fixed or are only a few units in the last place apart.
Result<double> enforce_draft_in_float(Solid& solid, double max_slope);

}  // namespace relievo
