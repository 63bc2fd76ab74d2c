// Points of the surface in rows beside its outlines, which take the place of scattered ones.
// Tested by tests/scan/outlines_test.cpp.
#pragma once

#include "relievo/scan/surface.h"
#include "scan/outlines/row_points.h"

namespace relievo {

// Finds the outlines of a triangulated surface, and replaces the points up to 3 rho from them by rows of
// evenly spaced ones, whose normals, depths and measures are interpolated from the points on the same side.
// Rows lie on the silhouette, on both sides of each jump, and parallel to them. Adds points where sampling
// leaves gaps inside the surface, and leaves out points outside. Then triangulates anew and sets the
// boundary: the silhouette's points are on it. Outlines that are known exactly, in view coordinates, take the
// place of those found near them. Changes nothing if there is no silhouette.
void put_points_on_outlines(Surface& surface, PointMeasures& measures,
                            std::span<const OutlineSegment> known_outlines = {});

// Marks triangles in gaps as outside, from the silhouette inwards. Such a gap lies between a surface and
// another one behind it that turns away from the viewer there, so that nothing is seen between the two.
void open_notches(Surface& surface);

}  // namespace relievo
