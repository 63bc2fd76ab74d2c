// Triangulates polygons that need not be convex. Tested by tests/io/polygon_test.cpp.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo::io {

// Returns triangles that cover a polygon, as numbers of its corners, in its sense of rotation. The polygon is
// taken as flat: what lies on top of itself in the plane of its vector area counts. A fan from the first
// corner is returned if it covers the polygon, and also if no triangles do: for polygons that cross
// themselves, have no area or a corner that is not finite, and for those of more than 10,000 corners that are
// not convex, which would take too long. Corners may coincide, as in polygons with holes that a seam connects
// with the outline.
std::vector<std::array<Index, 3>> triangulate(std::span<const Vec3> corners);

// Returns true if triangulate() returns the fan from the first corner because the fan covers the polygon.
bool fan_covers(std::span<const Vec3> corners);

// Calls add(a, b, c) for each triangle of triangulate(). This allocates nothing for the many polygons that a
// fan covers.
template <typename Add>
void for_each_triangle(std::span<const Vec3> corners, Add&& add) {
  if (corners.size() > 3 && !fan_covers(corners)) {
    for (const auto& [a, b, c] : triangulate(corners)) add(a, b, c);
    return;
  }
  for (Index i = 2; i < corners.size(); ++i) add(Index{0}, i - 1, i);
}

}  // namespace relievo::io
