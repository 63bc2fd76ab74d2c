// Finds depth jumps inside the silhouette: edges of the triangulation in the view plane whose ends belong to
// different parts of the surface.
#pragma once

#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Returns whether there is a depth jump between two neighbouring points: their depths differ by more than 3
// rho plus twice the difference that their normals explain.
bool is_jump(const Surface& surface, Index a, Index b);

// Returns for each triangle whether it is inside the relief and has an edge across a depth jump.
std::vector<std::uint8_t> jump_triangles(const Surface& surface);

}  // namespace relievo
