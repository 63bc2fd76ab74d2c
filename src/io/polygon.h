// Triangulates polygons that need not be convex. Tested by tests/io/polygon_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/scan/mesh.h"

namespace relievo::io {

// Returns triangles that cover a polygon, as indices of its corners, with the polygon's orientation. The
// polygon is treated as flat: it is projected onto the plane of its vector area. The result is a fan from the
// first corner if the fan covers the polygon. It is also a fan if no triangulation is found: for polygons
// that cross themselves, that have no area or a non-finite corner, and for non-convex polygons of more than
// 10,000 corners, which would take too long. Corners may coincide, as in polygons with holes that a seam
// connects with the outline.
std::vector<std::array<Index, 3>> triangulate(std::span<const Vec3> corners);

// Returns true if the fan from the first corner covers the polygon; triangulate() then returns this fan.
// After false, triangulate() may still return the fan, if it finds no triangulation.
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

// Triangulates the polygons and triangle strips of a file.

enum class FaceKind { polygon, strip, fan };

// Appends the triangles of a face, whose corners are indices of points. A polygon is triangulated, see
// triangulate(). A strip gives its triangles, every second one reversed, and restarts after each -1. A fan
// gives all triangles at its first corner. Triangles with two equal corners are left out. Returns false, and
// appends nothing, if a corner is not the index of a point.
bool add_face(std::span<const std::int64_t> corners, FaceKind kind, std::span<const Vec3> points,
              std::vector<Triangle>& triangles);

// Returns the message about a face that add_face() refuses, which names the corner that is not the index of a
// point.
std::string expected_corners(std::span<const std::int64_t> corners, std::span<const Vec3> points);

// Returns the mesh of the triangles over a cloud's points, without triangles that have a non-finite corner.
// The cloud's normals, if any, become the corners' normals.
Mesh mesh_over(const Cloud& cloud, std::vector<Triangle> triangles);

}  // namespace relievo::io
