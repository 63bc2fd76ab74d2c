// Depth jumps inside the silhouette: triangles of the view plane that no surface spans.
#pragma once

#include <vector>

#include "relievo/surface.h"

namespace relievo {

// Two neighbours in the view plane with another surface behind, or in front of, the one's.
bool is_jump(const Surface& surface, Index a, Index b);

// Per triangle: one of its edges is a jump.
std::vector<std::uint8_t> jump_triangles(const Surface& surface);

// Returns how much the slopes of each point count, in (0, 1]: a fifth where the depth jumps, all from .8 % of
// the longer side on. The slopes around a jump fit no surface that has none; where all count alike, the
// misfit tilts what lies between jumps, so most of it is left where it comes from.
std::vector<float> jump_weights(const Surface& surface);

}  // namespace relievo
