// Delaunay triangulation in the view plane (stages 6 and 13), with exact predicates.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A Delaunay triangulation of given points. All triangles are counter-clockwise, together they cover the
// convex hull, and no point lies strictly inside a triangle's circumcircle. All of this holds exactly.
struct Triangulation {
  std::vector<Triangle> triangles;
  // neighbours[t][i] is the triangle across the edge opposite to corner i of t, no_index on the hull.
  std::vector<Triangle> neighbours;
  // Convex hull, counter-clockwise, including points that lie on its edges.
  std::vector<Index> hull;
};

// Returns the Delaunay triangulation of `points`.
//
// - Of points with equal coordinates the one with the lowest index is used; the others are in no triangle.
// - If there are fewer than three distinct points, or all are on one line, there are no triangles and no
//   hull.
// - Cocircular points are triangulated in any valid way, the same for the same input on every machine.
// - The result is empty unless all coordinates are 0 or of a magnitude in [1e-60, 1e70], where the predicates
//   are exact, and there are fewer than 2^29 - 1 points.
//
// Time: O(n log n) for scans, grids and clusters; 340k random points take 0.13 s, a regular grid 0.4 s.
// Memory: about 150 bytes per point.
Triangulation delaunay(std::span<const Vec2> points);

}  // namespace relievo
