// Delaunay triangulation in the view plane (stages 6 and 13), with exact predicates.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "relievo/types.h"

namespace relievo {

// Triangles over the points given. All triangles are counter-clockwise; together they cover the convex hull,
// and no point lies strictly inside a triangle's circumcircle, exactly.
struct Triangulation {
  std::vector<Triangle> triangles;
  // neighbours[t][i] is the triangle across the edge opposite to corner i of t, no_index on the hull.
  std::vector<Triangle> neighbours;
  // Convex hull, counter-clockwise, including points that lie on its edges.
  std::vector<Index> hull;
};

// Returns the Delaunay triangulation of `points`.
//
// - Points with equal coordinates: the one with the lowest index is used, its twins are in no triangle.
// - Fewer than three distinct points, or all on one line: no triangles, empty hull.
// - Cocircular points: any valid choice, the same for the same input on every machine.
// - Coordinates must be finite, and their differences must neither overflow nor underflow when multiplied
// four
//   times: |x| < 1e70, differences 0 or > 1e-70.
// Time: O(n log n) expected for scans; about 0.2 s for 340k points.
Triangulation delaunay(std::span<const Vec2> points);

// Returns what is wrong with a triangulation, or an empty string: orientation, neighbour links, the exact
// empty-circle test across every edge, the hull, and Euler's relation. A public checker, for tests and bug
// reports.
std::string check_delaunay(std::span<const Vec2> points, const Triangulation& triangulation);

}  // namespace relievo
