// The last step of all baselines: sets boundary points to 0 and scales the heights to the height asked for.
#pragma once

#include <span>

#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Returns the relief with these heights, one per point, after setting boundary points to 0 and scaling all to
// `height`.
Relief scaled_relief(std::vector<double> heights, const Surface& surface, double height);

// Returns the depth of every point above the deepest one.
std::vector<double> depths(const Surface& surface);

}  // namespace relievo
