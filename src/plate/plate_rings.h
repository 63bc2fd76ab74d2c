// The ground around a relief: rings between convex polygons. Tested by solid_test.
#pragma once

#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// A convex polygon of the solid's points, counter-clockwise seen from +Z.
using IndexPolygon = std::vector<Index>;

// Adds the polygon's corners to the solid's points at height z; returns them.
IndexPolygon add_polygon(Solid& solid, const std::vector<Vec2>& corners, double z);

// Fills the ring between two convex polygons, the inner one strictly inside the outer, with triangles that
// cover it once. Every triangle has an area, even where corners are collinear or edges are parallel.
void add_ring(Solid& solid, IndexPolygon inner, IndexPolygon outer);

// Returns the outward offset that makes a point at the fraction `share` of a polygon's side a corner. With
// it, points of a side lie on an arc, whose middle is 0.00001 mm outside a side of 100 mm. Collinear corners
// would give triangles without area, and an ambiguous hull of the Delaunay triangulation.
inline Vec2 convexity_offset(const Vec2& side, double share) {
  const double curvature = 8e-9;  // per mm
  return share * (1 - share) / 2 * curvature * side.norm() * Vec2(side.y(), -side.x());
}

}  // namespace relievo
