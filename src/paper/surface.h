// Finds the surface of a view by the paper's rules alone (section 3.2): no noise is removed, no hole is filled, no
// point is added, and no visible point is left out.
#pragma once

#include "scan/measured_cloud.h"

namespace relievo::paper {

// Returns the visible points with normals, normalised mean curvature, Delaunay triangulation and boundary.
// `measured.serves(view)` must be true, and the view must not remove noise. Errors: kind geometry if fewer than 4
// points face the viewer or all visible points are collinear; kind cancelled.
//
// The paper does not say how P_b, the set of boundary points, is found. Here a triangle is outside the relief if its
// empty circle has a radius above 3 rho. P_b has the corners of these triangles, the points of the hull, and the
// points that are in no triangle.
Result<Surface> find_surface(const MeasuredCloud& measured, const View& view, Progress* progress = nullptr);

}  // namespace relievo::paper
