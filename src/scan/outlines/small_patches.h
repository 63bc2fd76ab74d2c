// Removes patches of a surface that are visible only through slits.
#pragma once

#include "relievo/scan/surface.h"
#include "scan/outlines/row_points.h"

namespace relievo {

// Removes the points of small patches behind their surroundings. A patch is a set of points that is
// separated from all others by depth jumps or by gaps of 3 rho. A small patch has no space for rows of points beside its
// outlines, and its surface cannot be recognised. Returns whether points were removed; then the triangulation
// and the boundary must be computed again.
bool drop_small_patches(Surface& surface, PointMeasures& measures);

}  // namespace relievo
