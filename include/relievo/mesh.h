// Triangle meshes, and the points that a viewer sees of them.
#pragma once

#include <array>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"
#include "relievo/view.h"

namespace relievo {

// Triangles in the units of their source. Corners of a triangle are numbers of points, all finite.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;  // counter-clockwise from outside, as far as the file keeps to that
  // Of each triangle's corners, unit length or zero where the file has none; empty if it has none at all.
  std::vector<std::array<Vec3f, 3>> corner_normals = {};
  std::vector<Colour> colours = {};  // per point, or empty

  bool empty() const { return triangles.empty(); }
};

// Returns unit normals for the corners of each triangle: of the triangles that meet in a corner those count
// that turn by less than `sharpest_deg` there, weighted by their angle. Corners at the same place meet,
// whatever their numbers. Zero for triangles without an area.
std::vector<std::array<Vec3f, 3>> smooth_normals(const Mesh& mesh, double sharpest_deg = 45);

// Returns the normals that are interpolated on the mesh: its own, or smooth_normals() where there are none,
// or where they are those of the triangles.
std::vector<std::array<Vec3f, 3>> normals_to_show(const Mesh& mesh);

struct MeshSampling {
  double points = 3e5;  // visible points to aim at, [100, 1e7]
  double spacing = 0;   // side of a square of the grid, in the mesh's units; 0 is what `points` asks for
};

// Errors: kind option for a number of points out of its range.
Result<void> check_points(double points);

// Returns the points that the viewer sees of the mesh, in the mesh's frame: one under the centre of each
// pixel of a square grid, as fine as gives about the wanted number, with normals interpolated between the
// corners, see normals_to_show(), and colours. Where the outline passes between two pixels there is a point
// on it, so that it is smoother than the grid. Both sides of a triangle are seen, and all normals face the
// viewer. Errors: kind geometry if nothing is seen in this view; kind option for a number of points out of
// its range; kind cancelled.
Result<Cloud> sample_mesh(const Mesh& mesh, const View& view, const MeshSampling& options = {},
                          Progress* progress = nullptr);

// Returns about `points` points all over the mesh, hidden sides included, evenly by area, with interpolated
// normals and colours: for those who turn it about. For a single view sample_mesh() is finer. Empty for a
// mesh without an area.
Cloud scatter(const Mesh& mesh, std::size_t points);

}  // namespace relievo
