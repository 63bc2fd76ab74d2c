// Triangulates the polygons and triangle strips of a file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/scan/mesh.h"

namespace relievo::io {

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
