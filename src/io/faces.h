// Polygons and strips of a file, as triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relievo/mesh.h"

namespace relievo::io {

enum class FaceKind { polygon, strip };

// Appends the triangles of a face: a fan from a polygon's first corner, right for convex polygons; a strip
// turned every second triangle, begun anew after each -1. Triangles with two equal corners are left out.
// Returns false, having added none, if a corner is not one of `points`.
bool add_face(std::span<const std::int64_t> corners, FaceKind kind, std::size_t points,
              std::vector<Triangle>& triangles);

// Returns the mesh of triangles over the points of a cloud, without the triangles that have a corner which is
// not finite. Where the cloud has normals these are the corners'.
Mesh mesh_over(const Cloud& cloud, std::vector<Triangle> triangles);

// Lets points at the same place be one, so that triangles that were given corner by corner are connected.
void weld(Mesh& mesh);

}  // namespace relievo::io
