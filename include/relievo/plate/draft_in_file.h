// Measures and limits the slopes of a solid as files store it, with coordinates rounded to single precision.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Returns the steepest slope (tangent) of the front's triangles, with corners rounded to single precision as
// in files. The result is infinite if a triangle whose corners differ in height is vertical or overhangs.
double steepest_slope(const Solid& solid);

// Moves points of the solid's front up or down, as far as rounding to single precision requires, until no
// front triangle is steeper than the limit in a file. Returns the largest move in mm, usually below 1e-5. The
// ground, the highest and the lowest points stay. Errors: kind geometry, with the solid unchanged, if no such
// moves are found. The reason is that the front was too steep before, or that rounding made triangles too
// steep whose points are fixed or only a few steps of single precision apart.
Result<double> enforce_draft_in_float(Solid& solid, double max_slope);

}  // namespace relievo
