// The triangulation of the control points, which of its triangles belong to the relief, and samples of the regions
// around the points.
#pragma once

#include <span>
#include <vector>

#include "relievo/relief/control_points.h"
#include "relievo/scan/boundary.h"
#include "relievo/scan/surface.h"

namespace relievo {

struct ControlMesh {
  std::vector<Vec2> points;
  Triangulation triangulation;
  Boundary boundary;  // without distances
};

// Returns the mesh of a surface's control points. A triangle is inside if most of its area is covered by
// inside triangles of the surface, so that holes and concavities stay outside. The boundary points are those
// of the surface; every connected piece has at least one.
ControlMesh mesh_control_points(const Surface& surface, const ControlPoints& control);

// Returns `per_region` points for each control point in turn, from the points nearest to it. Each represents
// the same area in the view plane; in small regions some points are repeated.
std::vector<Index> sample_regions(const Surface& surface, const ControlPoints& control,
                                  std::size_t per_region);

}  // namespace relievo
