// Computes the mean curvature of the moving-least-squares surface (section 3.2), equations (2) and (3).
#pragma once

#include <span>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"

namespace relievo::paper {

// Returns the mean curvature at the points with the indices `queries`, in 1 / length, positive where the surface is
// convex. Q, the neighbours of a point, are all points of the cloud within 3 h. The Gaussian weight is
// exp(-d^2 / h^2), and h is 3 rho. Normals must have unit length. The curvature is 0 where the gradient of g is 0. If
// no curvature exceeds 1e-6 / rho, the surface is flat up to the rounding of normals, and all curvatures are set to 0.
// After cancellation, returns early with meaningless values.
//
// If normals point outwards, the printed (3) is -2 times the mean curvature (see docs/decisions/paper.md). So
// this function divides the result of (3) by -2. Without this division, the second equation (9), which adds
// detail, would flatten ridges.
std::vector<double> mean_curvature(const Cloud& cloud, double rho, std::span<const Index> queries,
                                   const Progress* progress = nullptr);

}  // namespace relievo::paper
