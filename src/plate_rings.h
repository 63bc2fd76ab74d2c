// The ground around a relief: rings between convex polygons.
#pragma once

#include <vector>

#include "relievo/solid.h"

namespace relievo {

// A convex polygon of the solid's points, counter-clockwise seen from +Z.
using Loop = std::vector<Index>;

// Adds the polygon's corners to the solid's points.
Loop add_loop(Solid& solid, const std::vector<Vec2>& polygon, double z);

// Fills the ring between two convex polygons, the inner strictly inside the outer: triangles that cover it
// once, each with an area, also where corners are collinear or edges are parallel.
void add_ring(Solid& solid, Loop inner, Loop outer);

}  // namespace relievo
