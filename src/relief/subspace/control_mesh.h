// The triangulation of the control points, in which the triangles inside the relief are marked, and samples
// of the surface for each control point.
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
// inside triangles of the surface, so that holes and concavities stay outside. Boundary points are the
// control points on the surface's boundary; every connected component has at least one boundary point.
ControlMesh mesh_control_points(const Surface& surface, const ControlPoints& control);

// Returns, for each control point in turn, `per_region` points of its region: surface points that are nearer
// to it than to any other control point. Each stands for an equal part of the region's area in the view
// plane. If a region has few points, some are repeated; if it has no area, the control point itself is.
std::vector<Index> sample_regions(const Surface& surface, const ControlPoints& control,
                                  std::size_t per_region);

}  // namespace relievo
