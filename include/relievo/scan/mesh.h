// Defines triangle meshes, and samples points from them.
#pragma once

#include <array>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/view.h"

namespace relievo {

// A triangle mesh in the units of its source. All coordinates are finite, and triangles refer to existing
// points.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;  // counter-clockwise seen from outside, if the file is consistent
  // The unit normals of each triangle's corners; zero where the file has none. Empty if the file has no
  // normals.
  std::vector<std::array<Vec3f, 3>> corner_normals = {};
  std::vector<Colour> colours = {};     // colours of the points, or empty
  std::vector<float> own_heights = {};  // per point, see Cloud; may be empty

  bool empty() const { return triangles.empty(); }
};

// Returns unit normals for the corners of each triangle. The normal of a corner is the angle-weighted mean of
// the normals of the triangles at that position; triangles whose normals differ by more than `sharpest_deg`
// degrees from the corner's own triangle are ignored. Different points at the same position count as one.
// Triangles without area have zero normals.
std::vector<std::array<Vec3f, 3>> smooth_normals(const Mesh& mesh, double sharpest_deg = 45);

// Returns the corner normals for interpolation: the mesh's own normals, or smooth_normals() if the mesh has
// none or only the normals of its flat triangles.
std::vector<std::array<Vec3f, 3>> normals_to_show(const Mesh& mesh);

struct MeshSampling {
  double points = 3e5;  // approximate number of visible points, [100, 1e7]
  double spacing = 0;   // distance between points, in the mesh's units; if 0, `points` decides
};

// Returns an error of kind option if MeshSampling::points is out of range.
Result<void> check_points(double points);

// Returns the visible points of the mesh, in its axes: one at the centre of each pixel of a square grid over
// the view, with interpolated normals (see normals_to_show()) and colours. Further points are on the outline
// between pixels, so that the outline is smoother than the grid. Triangles are visible from both sides, and
// all normals face the viewer. Errors: kind geometry if nothing is visible in this view; kind option for a
// number of points out of range; kind cancelled.
Result<Cloud> sample_mesh(const Mesh& mesh, const View& view, const MeshSampling& options = {},
                          Progress* progress = nullptr);

// Returns about `points` points, evenly distributed over the whole area of the mesh, including hidden parts,
// with interpolated normals and colours, for display from any direction. For a single view sample_mesh()
// gives more detail. The result is empty for a mesh without area.
Cloud scatter(const Mesh& mesh, std::size_t points);

}  // namespace relievo
