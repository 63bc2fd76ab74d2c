// Replaces the scattered points near a surface's outlines by rows of points. Tested by
// tests/scan/outlines_test.cpp.
#pragma once

#include "relievo/scan/surface.h"
#include "scan/outlines/row_points.h"

namespace relievo {

// Finds the outlines of a triangulated surface, and replaces the points within 3 rho of them by rows of
// evenly spaced points. The rows are on the silhouette, on both sides of each jump, and parallel to
// silhouette and jumps. Normals, depths and measures of new points are interpolated from points on the same
// side of the outlines. Points are added where sampling leaves gaps inside the surface, and points outside
// are removed. Then the surface is triangulated again, and its boundary is set to the points of the
// silhouette. `known_outlines`, exact outlines in view coordinates, replace outlines found near them. Does
// nothing if there is no silhouette.
void put_points_on_outlines(Surface& surface, PointMeasures& measures,
                            std::span<const OutlineSegment> known_outlines = {});

// Marks triangles in notches as outside, from the silhouette inwards. A notch is a gap between two surfaces, where the
// one behind turns away from the viewer. So no surface is visible in the gap.
void open_notches(Surface& surface);

// Removes the points of small patches behind their surroundings. A patch is a set of points that is
// separated from all others by depth jumps or by gaps of 3 rho. A small patch has no space for rows of points beside its
// outlines, and its surface cannot be recognised. Returns whether points were removed; then the triangulation
// and the boundary must be computed again.
bool drop_small_patches(Surface& surface, PointMeasures& measures);

}  // namespace relievo
