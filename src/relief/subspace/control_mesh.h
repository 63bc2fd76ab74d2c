// The triangles between control points, and which of them belong to the relief.
#pragma once

#include <span>

#include "relievo/boundary.h"
#include "relievo/relief/control_points.h"
#include "relievo/scan/surface.h"

namespace relievo {

struct ControlMesh {
  std::vector<Vec2> points;
  Triangulation triangulation;
  Boundary boundary;  // without distances
};

// Returns the mesh of a surface's control points. A triangle is inside if most of its area is covered by
// triangles of the surface that are, so that holes and concavities stay outside; boundary points are those of
// the surface. Every connected piece has one.
ControlMesh mesh_control_points(const Surface& surface, const ControlPoints& control);

}  // namespace relievo
