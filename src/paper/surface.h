// The surface of a view by the paper's rules alone (section 3.2): no noise is removed, no hole is filled, no
// point is added, and no visible point is left out.
#pragma once

#include "scan/measured_cloud.h"

namespace relievo::paper {

// Returns the visible points with their normals, normalised mean curvature, Delaunay triangulation and
// boundary. The view must be one that `measured` serves and must ask for no removal of noise. Errors: kind
// geometry if fewer than 4 points face the viewer or all visible points are on one line; kind cancelled.
//
// The paper does not say how P_b is found. Here a triangle with an empty circle of more than 3 rho is outside
// the relief, and its corners are in P_b.
Result<Surface> find_surface(const MeasuredCloud& measured, const View& view, Progress* progress = nullptr);

}  // namespace relievo::paper
