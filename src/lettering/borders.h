// Computes the outlines of borders along the rim: lines, beads and ropes. Tested by
// tests/lettering/ornament_shapes_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "geometry/outline_union.h"

namespace relievo {

// A row of equal beads or strands along a convex polygon.
struct BorderRow {
  std::vector<Vec2> path;
  double width_mm = 0;
  double count = 0;  // number of beads or strands; 0: as many as fit well
};

// Returns both edges of a line with the given width. The outer edge is `before_mm` inside the polygon.
Outlines line_outlines(std::span<const Vec2> polygon, double before_mm, double width_mm);

// Returns discs whose diameter is the width of the row.
Outlines bead_outlines(const BorderRow& row);

// Returns ellipses that are tilted against the path, as the strands of a rope.
Outlines rope_outlines(const BorderRow& row);

// Returns the radius of the largest circle inside a bead, which is a polygon.
double bead_radius(const BorderRow& row);

// Returns the smaller half axis of a rope's ellipse.
double strand_radius(const BorderRow& row);

}  // namespace relievo
