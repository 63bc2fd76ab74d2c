// Triangulates the polygons and triangle strips of a file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/scan/mesh.h"

namespace relievo::io {

enum class FaceKind { polygon, strip, fan };

// Appends the triangles of a face, whose corners are numbers of points. For a polygon, these are triangles
// that cover it, see triangulate(); for a strip, its triangles, every second one reversed, with a restart
// after each -1; for a fan, all triangles at its first corner. Triangles with two equal corners are left out.
// Returns false, and appends nothing, if a corner is not the number of a point.
bool add_face(std::span<const std::int64_t> corners, FaceKind kind, std::span<const Vec3> points,
              std::vector<Triangle>& triangles);

// Returns the message about a face that add_face() refuses: which corner is not the number of a point.
std::string expected_corners(std::span<const std::int64_t> corners, std::span<const Vec3> points);

// Returns the mesh of the triangles over a cloud's points, without triangles that have a corner which is not
// finite. The cloud's normals, if any, become the corners' normals.
Mesh mesh_over(const Cloud& cloud, std::vector<Triangle> triangles);

}  // namespace relievo::io
