// Shapes that stand out of a plane, or sink into it, with heights that depend on the distance to their outline.
// Tested by tests/geometry/raised_shape_test.cpp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/held_edges.h"
#include "geometry/outline_union.h"
#include "relievo/core/types.h"

namespace relievo {

// A point of a shape's cross-section: the height at a distance from the outline.
struct WallLevel {
  double distance_mm = 0, height_mm = 0;
};

// Outlines and the heights of the area that they cover; negative heights sink it. Between levels the height is linear; beyond the
// last one it stays. The first level is 0, 0; distances rise.
struct RaisedShape {
  std::string name;  // for errors
  Outlines outlines;
  std::vector<WallLevel> levels;
  double spacing_mm = .2;  // largest distance between points along the outlines, > 0
};

// Returns the levels of walls that lean by `slope` up to that height; a negative height sinks them.
std::vector<WallLevel> leaning_wall(double height_mm, double slope);

// Returns the levels of a ball's cap over a disc of that radius, nowhere steeper than `slope`. The cap is as high
// as that allows, at most `height_mm`, which sinks it if it is negative.
std::vector<WallLevel> round_wall(double height_mm, double radius_mm, double slope);

// The points of a shape and the edges between them that keep its outline and its levels sharp.
struct ShapePoints {
  std::vector<Vec3> points;  // z is the height over the plane
  std::vector<EdgeEnds> edges;
  std::size_t feet = 0;    // the first points are those on the outline
  double most_mm = 0;      // largest height or depth
  double thinnest_mm = 0;  // width of the thinnest stroke; infinite if there is none
};

// Returns points of the shape whose heights are exact: on the outline, along each level, and where the walls of
// a stroke meet because it is too thin for the last level.
ShapePoints points_of(const RaisedShape& shape);

}  // namespace relievo
