// Outlines of borders along the rim: lines, beads and ropes. Tested by
// tests/lettering/ornament_shapes_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "geometry/outline_union.h"

namespace relievo {

// A row of equal pieces along a convex polygon.
struct BorderRow {
  std::vector<Vec2> path;
  double width_mm = 0;
  double count = 0;  // 0: as many as fit well
};

// Returns the two edges of a line of that width, whose outer edge lies `before` inside the polygon.
Outlines line_outlines(std::span<const Vec2> polygon, double before_mm, double width_mm);

// Returns discs whose diameter is the row's width.
Outlines bead_outlines(const BorderRow& row);

// Returns slanting ellipses.
Outlines rope_outlines(const BorderRow& row);

// Returns the radius of the largest circle within a disc, which is a polygon.
double bead_radius(const BorderRow& row);

// Returns half the smaller diameter of a rope's ellipse.
double strand_radius(const BorderRow& row);

}  // namespace relievo
