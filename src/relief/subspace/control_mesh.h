// Triangulates the control points, and samples the surface around each of them.
#pragma once

#include <vector>

#include "relievo/relief/control_points.h"
#include "relievo/scan/boundary.h"
#include "relievo/scan/surface.h"

namespace relievo {

struct ControlMesh {
  std::vector<Vec2> points;
  Triangulation triangulation;
  Boundary boundary;  // only is_inside and is_boundary are set
};

// Returns the mesh of a surface's control points. A triangle of the mesh is inside if triangles inside the
// surface cover most of its area, so holes and concavities stay outside. The boundary points of the mesh are
// the control points on the surface's boundary, and at least one point in each connected component.
ControlMesh mesh_control_points(const Surface& surface, const ControlPoints& control);

// Returns `per_region` points of each control point's region, region by region. A region contains the surface
// points that are nearest to its control point. Each sample represents an equal part of the region's area in
// the view plane. Samples are repeated if the region has fewer points. If it has no area, all samples are the
// control point.
std::vector<Index> sample_regions(const Surface& surface, const ControlPoints& control,
                                  std::size_t per_region);

}  // namespace relievo
