// A picture of the surface that a milling tool reaches.
#pragma once

#include "relievo/plate/tool.h"

namespace relievo {

// Returns the front from above, shaded, with the material that the tool leaves coloured from orange to red,
// by its share of the largest residual. The result has no pixels if there are no samples.
Image8 render_reach(const ToolReach& reach, int longer_side_px);

}  // namespace relievo
