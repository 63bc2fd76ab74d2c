// Leaves out surfaces that are seen only through slits. Tested by tests/scan/small_patches_test.cpp.
#pragma once

#include "relievo/scan/surface.h"
#include "scan/outlines/row_points.h"

namespace relievo {

// Removes the points of small patches: sets of points that depth jumps, or gaps of 3 rho, separate from all
// others, and that lie behind the points around them. Such a patch is too small for rows of points beside its
// outlines, and the surface that it belongs to is not seen. Returns whether points were removed; the
// triangulation and the boundary then have to be found anew.
bool drop_small_patches(Surface& surface, PointMeasures& measures);

}  // namespace relievo
