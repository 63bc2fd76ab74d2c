// Triangulates polygons that need not be convex. Tested by tests/io/polygon_test.cpp.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::io {

// Returns triangles that cover a polygon, as numbers of its corners, in its sense of rotation. The polygon is
// taken as flat: what lies on top of itself in the plane of its vector area counts. A fan from the first
// corner is returned if it covers the polygon, and also where nothing does: for polygons that cross
// themselves, have no area or a corner that is not finite, and for those of more than 10,000 corners that are
// not convex, which would take too long. Corners may coincide, as in polygons with holes that a seam connects
// with the outline.
std::vector<std::array<Index, 3>> triangulate(std::span<const Vec3> corners);

}  // namespace relievo::io
