// Triangle meshes, and sampling of points from them.
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
  std::vector<Triangle> triangles;  // counter-clockwise from outside if the file is consistent
  // The normals of each triangle's corners, with unit length, or zero where the file has none. Empty if the
  // file has no normals at all.
  std::vector<std::array<Vec3f, 3>> corner_normals = {};
  std::vector<Colour> colours = {};     // colours of the points, or empty
  std::vector<float> own_heights = {};  // of the points, see Cloud; or empty

  bool empty() const { return triangles.empty(); }
};

// Returns unit normals for the corners of each triangle. A corner's normal is the mean of the normals of the
// triangles that meet there, weighted by their angles; only triangles count whose normals differ by at most
// `sharpest_deg` degrees from the normal of the corner's own triangle. Triangles also meet where different
// points have the same position. Normals of triangles without area are zero.
std::vector<std::array<Vec3f, 3>> smooth_normals(const Mesh& mesh, double sharpest_deg = 45);

// Returns the corner normals to interpolate on the mesh: the mesh's own, or smooth_normals() if the mesh has
// none or only the normals of its flat triangles.
std::vector<std::array<Vec3f, 3>> normals_to_show(const Mesh& mesh);

struct MeshSampling {
  double points = 3e5;  // approximate number of visible points to return, [100, 1e7]
  double spacing = 0;   // distance between points, in the mesh's units; 0: chosen to obtain about `points`
};

// Checks MeshSampling::points. Errors: kind option if it is out of its range.
Result<void> check_points(double points);

// Returns the visible points of the mesh, in the mesh's frame: one at the centre of each pixel of a square
// grid over the view, with normals interpolated between the corners (see normals_to_show()), and colours.
// Further points lie on the outline between pixels, so that it is smoother than the grid. Triangles are
// visible from both sides, and all normals face the viewer. Errors: kind geometry if nothing is visible in
// this view; kind option for a number of points out of its range; kind cancelled.
Result<Cloud> sample_mesh(const Mesh& mesh, const View& view, const MeshSampling& options = {},
                          Progress* progress = nullptr);

// Returns about `points` points distributed evenly over the whole area of the mesh, hidden sides included,
// with interpolated normals and colours, for display from any side. For a single view sample_mesh() is more
// detailed. Empty for a mesh without area.
Cloud scatter(const Mesh& mesh, std::size_t points);

}  // namespace relievo
