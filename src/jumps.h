// Depth jumps inside the silhouette: triangles of the view plane that no surface spans.
#pragma once

#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Two neighbours in the view plane with another surface behind, or in front of, the one's.
bool is_jump(const Surface& surface, Index a, Index b);

// Per triangle: one of its edges is a jump.
std::vector<std::uint8_t> jump_triangles(const Surface& surface);

// Returns, per point, how much its edges count in (9): .2 where the depth jumps by 2 % of the longer side or
// more, rising by equal factors to 1 at .8 % of it. No surface without the jump fits the slopes of both its
// sides; that misfit would tilt all around, so most of it is left at the jump.
std::vector<float> jump_weights(const Surface& surface);

}  // namespace relievo
