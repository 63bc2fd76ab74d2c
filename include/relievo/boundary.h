// Boundary (stage 5): where the relief ends and the base begins.
#pragma once

#include <span>
#include <vector>

#include "relievo/cloud.h"
#include "relievo/spacing.h"
#include "relievo/triangulation.h"

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

// Returns the boundary of the visible points `points` (x, y of view coordinates), triangulated by
// `triangulation`.
//
// A triangle is outside if its circumcircle, empty by Delaunay, is wider than the gap, unless some point of
// `whole`, hidden or turned away, covers its middle: there the model is seen but not scanned from this side,
// and the relief bridges the gap. The boundary is one point thick: the corners of outside triangles, and the
// hull. A point in no inside triangle is a boundary point.
Boundary find_boundary(std::span<const Vec2> points, const Triangulation& triangulation, const Cloud& whole,
                       const Spacing& spacing, const BoundaryOptions& options = {});

}  // namespace relievo
