// The ground of a plate: from the front's hull out to the outline, with its rim.
// Tested by plate_rim_test and outline_test.
#pragma once

#include <limits>
#include <vector>

#include "plate/plate_rings.h"
#include "relievo/plate/solid.h"

namespace relievo {

// The outline of a plate with ground. The lower left corner of its box is the origin.
struct PlateOutline {
  std::vector<Vec2> polygon;         // convex, counter-clockwise
  Vec2 front_corner = Vec2::Zero();  // the lower left corner of the front's box
};

PlateOutline outline_of_plate(const HeightFieldMesh& front, const Box& box, const PlateOptions& options);

// An edge of the rim, or the outline.
struct RimEdge {
  std::vector<Vec2> polygon;
  double height_mm = 0;  // above the ground
};

// Returns the rim's edges from the inner one to the outline; the outline alone if there is no rim.
std::vector<RimEdge> rim_edges(const PlateOutline& outline, const RimOptions& rim);

// Returns the polygon inside the rim; the outline itself if there is no rim.
std::vector<Vec2> rim_inner_polygon(const PlateOutline& outline, const RimOptions& rim);

struct GroundOptions {
  RimOptions rim;
  double spacing = std::numeric_limits<double>::infinity();  // spacing of the points on outline and ground
};

// Adds the ground to the placed front, with its regions, and returns the outline's points. With a finite
// spacing there are points at that distance along the outline, and on the ground if the front's triangles
// allow it, see fill_ground().
IndexPolygon add_ground(Solid& solid, const HeightFieldMesh& front, const PlateOutline& outline,
                        const GroundOptions& options);

}  // namespace relievo
