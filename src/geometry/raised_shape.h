// Computes points of shapes that rise above a plane or sink below it. The height of a shape depends on the distance
// from its outline.
#pragma once

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

// Outlines, and the cross-section of the area that they cover. Between levels the height is linear; beyond
// the last level it is constant. Negative heights sink the area. The first level has distance 0 and height 0; distances
// increase.
struct RaisedShape {
  std::string name;  // name of the shape in errors
  Outlines outlines;
  std::vector<WallLevel> levels;
  double spacing_mm = .2;  // largest distance between points along the outlines, > 0
};

// Returns the levels of a wall with this slope up to this height; a negative height sinks the shape.
std::vector<WallLevel> leaning_wall(double height_mm, double slope);

// Returns the levels of a spherical cap over a disc with this radius, nowhere steeper than `slope`. The cap
// is as high as the slope allows, but at most `height_mm`; a negative height sinks it.
std::vector<WallLevel> round_wall(double height_mm, double radius_mm, double slope);

// Points of a shape, and edges that keep its outline and its levels sharp in a triangulation.
struct ShapePoints {
  std::vector<Vec3> points;  // z is the height above the plane
  std::vector<EdgeEnds> edges;
  std::size_t feet = 0;    // the first points are on the outline; this is their number
  double most_mm = 0;      // largest height or depth
  double thinnest_mm = 0;  // width of the thinnest stroke; infinite if none is thinner than 2 mm
};

// Returns points of the shape with exact heights: on the outline, along each level, and where the walls of a
// stroke meet because it is too thin for the last level.
ShapePoints points_of(const RaisedShape& shape);

}  // namespace relievo
