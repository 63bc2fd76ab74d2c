// The ground around a relief: rings between convex polygons.
#pragma once

#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// A convex polygon of the solid's points, counter-clockwise seen from +Z.
using Loop = std::vector<Index>;

// Adds the polygon's corners to the solid's points.
Loop add_loop(Solid& solid, const std::vector<Vec2>& polygon, double z);

// Fills the ring between two convex polygons, the inner strictly inside the outer: triangles that cover it
// once, each with an area, also where corners are collinear or edges are parallel.
void add_ring(Solid& solid, Loop inner, Loop outer);

// How far a point that lies `share` of the way along a side of this polygon is to be moved outwards so that
// it is a corner, too: sides become arcs of the same circle, 0.00001 mm off their middle where they are 100
// mm long.
inline Vec2 bulge(const Vec2& side, double share) {
  const double curvature = 8e-9;
  return share * (1 - share) / 2 * curvature * side.norm() * Vec2(side.y(), -side.x());
}

}  // namespace relievo
