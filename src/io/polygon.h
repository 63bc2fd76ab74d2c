// Triangulates polygons that need not be convex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/scan/mesh.h"

namespace relievo::io {

// Returns triangles that cover a polygon, as indices of its corners, with the polygon's orientation. The
// polygon is projected onto the plane of its vector area. If the fan from the first corner covers the
// polygon, the result is that fan. It is also the fan if no triangulation is found: for polygons that
// intersect themselves, have no area or have a non-finite corner, and for non-convex polygons of more than
// 10,000 corners, which would take too long. Corners may coincide, as in polygons whose holes are connected
// with the outline by a seam.
std::vector<std::array<Index, 3>> triangulate(std::span<const Vec3> corners);

// Returns whether the fan from the first corner covers the polygon. If so, triangulate() returns this fan; if
// not, triangulate() may still return the fan, when it finds no triangulation.
bool fan_covers(std::span<const Vec3> corners);

// Calls add(a, b, c) for each triangle of triangulate(). Allocates nothing if a fan covers the polygon.
template <typename Add>
void for_each_triangle(std::span<const Vec3> corners, Add&& add) {
  if (corners.size() > 3 && !fan_covers(corners)) {
    for (const auto& [a, b, c] : triangulate(corners)) add(a, b, c);
    return;
  }
  for (Index i = 2; i < corners.size(); ++i) add(Index{0}, i - 1, i);
}

// The ways in which files list the corners of a face.

enum class FaceKind { polygon, strip, fan };

// Appends the triangles of a face, whose corners are indices of points. For a polygon see triangulate(). In a
// strip every second triangle is reversed, and -1 begins a new strip. All triangles of a fan contain its
// first corner. Triangles with two equal corners are left out. Returns false, and appends nothing, if a
// corner is not the index of a point.
bool add_face(std::span<const std::int64_t> corners, FaceKind kind, std::span<const Vec3> points,
              std::vector<Triangle>& triangles);

// Returns the message for a face that add_face() refuses. It names the corner that is not the index of a
// point.
std::string expected_corners(std::span<const std::int64_t> corners, std::span<const Vec3> points);

// Returns the mesh of these triangles over a cloud's points, without triangles that have a non-finite corner.
// The cloud's normals, if any, become corner normals.
Mesh mesh_over(const Cloud& cloud, std::vector<Triangle> triangles);

}  // namespace relievo::io
