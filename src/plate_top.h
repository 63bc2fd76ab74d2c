// What is seen of a plate from the front: relief, ground and rim, before it becomes a body.
#pragma once

#include <limits>
#include <vector>

#include "plate_rings.h"
#include "relievo/plate/solid.h"

namespace relievo {

// At no height in particular; its outline is empty without ground.
struct Top {
  Solid solid;
  Loop outline;
  double spacing = std::numeric_limits<double>::infinity();  // of its ground
};

Box used_box(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);

// Gives the last points, which the front does not know, the plate's colour, if points have colours.
void fill_colours(Solid& solid);

// Returns the base in the front's coordinates. The front is as the plate shows it.
Result<Base> base_of(const Front& front, const PlateOptions& options);

// Returns the top on its base, or flat and fine enough for its wrap.
Result<Top> make_top(const Front& front, const Base& base, const PlateOptions& options);

}  // namespace relievo
