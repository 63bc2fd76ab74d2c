// Boundary (stage 5): where the relief ends and the base begins.
#pragma once

#include <span>
#include <vector>

#include "relievo/geometry/triangulation.h"

namespace relievo {

struct BoundaryOptions {
  double gap =
      3;  // an empty circle wider than this radius, in rho, is outside the relief, a narrower one is sampling
  double smallest_hole =
      5;  // a hole inside the silhouette with no empty circle of this radius, in rho, is closed
};

struct Boundary {
  std::vector<std::uint8_t> is_inside;    // per triangle: part of the relief
  std::vector<std::uint8_t> is_boundary;  // per point: in P_b, on the silhouette or on an inner hole's rim
  std::vector<float> distance;  // per point: `dist` of (7), distance in the plane to the nearest of P_b
};

// Returns the boundary of points in the view plane, triangulated by `triangulation`, with sampling distance
// rho.
//
// A triangle is outside if its circumcircle, empty by Delaunay, is wider than the gap, and neither it nor the
// outside triangles connected with it are a narrow hole. The boundary is one point thick: the corners of
// outside triangles, and the hull. A point in no inside triangle is a boundary point.
Boundary find_boundary(std::span<const Vec2> points, const Triangulation& triangulation, double rho,
                       const BoundaryOptions& options = {});

}  // namespace relievo
