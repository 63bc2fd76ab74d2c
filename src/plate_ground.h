// The ground of a plate: from the front's hull out to the outline, with its rim.
#pragma once

#include <limits>
#include <vector>

#include "plate_rings.h"
#include "relievo/plate/solid.h"

namespace relievo {

// The outline of a plate with ground, from the far, lower left corner of the plate's box; and where that of
// the front's box lies in it.
struct Ground {
  std::vector<Vec2> outline;
  Vec2 corner = Vec2::Zero();
};

Ground ground_around(const Front& front, const Box& box, const PlateOptions& options);

// The polygon within which there is no rim.
std::vector<Vec2> foot_polygon(const Ground& ground, const RimOptions& rim);

struct GroundOptions {
  RimOptions rim;
  double spacing = std::numeric_limits<double>::infinity();
};

// Adds the ground to the placed front, with its regions. With a finite spacing there is a
// point so often along the outline, and on the ground where the front's triangles let it, see fill_ground().
// Returns the loop of the outline.
Loop add_ground(Solid& solid, const Front& front, const Ground& ground, const GroundOptions& options);

}  // namespace relievo
