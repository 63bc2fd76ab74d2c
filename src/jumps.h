// Depth jumps inside the silhouette: triangles of the view plane that no surface spans.
#pragma once

#include <vector>

#include "relievo/surface.h"

namespace relievo {

// Two neighbours in the view plane with another surface behind, or in front of, the one's.
bool is_jump(const Surface& surface, Index a, Index b);

// Per triangle: one of its edges is a jump.
std::vector<std::uint8_t> jump_triangles(const Surface& surface);

}  // namespace relievo
