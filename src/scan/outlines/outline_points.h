// Replaces the scattered points beside a surface's outlines by rows of points. Tested by
// tests/scan/outlines_test.cpp.
#pragma once

#include "relievo/scan/surface.h"
#include "scan/outlines/row_points.h"

namespace relievo {

// Finds the outlines of a triangulated surface, and replaces the points up to 3 rho from them by rows of
// evenly spaced points. Normals, depths and measures of the new points are interpolated from the points on
// the same side. Rows lie on the silhouette, on both sides of each jump, and parallel to them. Adds points
// where sampling leaves gaps inside the surface, and leaves out points outside. Then triangulates anew and
// sets the boundary: the silhouette's points are on it. Known exact outlines, in view coordinates, take the
// place of outlines found near them. Changes nothing if there is no silhouette.
void put_points_on_outlines(Surface& surface, PointMeasures& measures,
                            std::span<const OutlineSegment> known_outlines = {});

// Marks triangles in gaps as outside, from the silhouette inwards. Such a gap lies between a surface and
// another one behind it that turns away from the viewer there, so that no surface is seen between the two.
void open_notches(Surface& surface);

}  // namespace relievo
