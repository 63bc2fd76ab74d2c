// The front of a solid, from the heights of a relief.
#pragma once

#include "relievo/core/progress.h"
#include "relievo/options.h"
#include "relievo/plate/solid.h"
#include "relievo/relief/relief.h"

namespace relievo {

struct FormedFront {
  HeightFieldMesh front;
  double height_mm = 0;                // lowest to highest point
  double simplification_error_mm = 0;  // largest difference to the front with all samples
  std::size_t full_triangles = 0;      // triangles of that front
};

// Returns the points at these heights, in millimetres, on the surface's triangles.
HeightFieldMesh front_in_mm(const Surface& surface, const std::vector<double>& heights, double mm_per_unit);

// Returns the front with all its samples in the form that the options ask for. Errors: `cancelled`.
Result<FormedFront> full_front(const Surface& surface, const Relief& relief, const ReliefOptions& options,
                               const Progress* progress);

// Returns the front, simplified as the options ask unless make_plate() will simplify. With the outline `none`
// it is only the relief. Errors: those of simplify().
Result<FormedFront> simplified_front(FormedFront full, const ReliefOptions& options, Progress* progress);

// Returns the depth of the front's lowest point below the ground: 0 or more.
double depth_below_ground(const HeightFieldMesh& front);

}  // namespace relievo
