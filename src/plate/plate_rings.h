// The ground around a relief: rings between convex polygons.
// Tested by solid_test.
#pragma once

#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// A convex polygon of the solid's points, counter-clockwise seen from +Z.
using IndexPolygon = std::vector<Index>;

// Adds the polygon's corners to the solid's points at height z; returns them.
IndexPolygon add_polygon(Solid& solid, const std::vector<Vec2>& corners, double z);

// Fills the ring between two convex polygons, the inner one strictly inside the outer, with triangles that
// cover it once. Each has an area, even where corners are collinear or edges are parallel.
void add_ring(Solid& solid, IndexPolygon inner, IndexPolygon outer);

// Returns how far to move a point that lies `share` of the way along a polygon's side outwards so that it
// becomes a corner: sides become arcs of one circle, 0.00001 mm off their middle where they are 100 mm long.
// Collinear corners would leave triangles without an area, and to a Delaunay triangulation a choice of the
// hull.
inline Vec2 convexity_offset(const Vec2& side, double share) {
  const double curvature = 8e-9;  // per mm
  return share * (1 - share) / 2 * curvature * side.norm() * Vec2(side.y(), -side.x());
}

}  // namespace relievo
