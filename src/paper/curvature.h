// The mean curvature of the moving-least-squares surface (section 3.2), equations (2) and (3).
#pragma once

#include <span>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"

namespace relievo::paper {

// Returns the mean curvature at the points with the indices `queries`, in 1 / length, positive where the
// surface is convex. Q, the neighbours of a point, are all points of the cloud within 3 h, and the Gaussian
// weight is exp(-d^2 / h^2); h is 3 rho. The curvature is 0 where the gradient of g vanishes. Normals have unit length.
// If no curvature is above 1e-6 / rho, the surface is flat up to the rounding of normals, and all are 0. Once the progress is cancelled, it ends early and the values have no meaning.
//
// The printed (3) is twice the mean curvature, and negative for normals that point outwards. Its sign and the
// factor are changed here: otherwise detail, the second (9), would flatten
// ridges.
std::vector<double> mean_curvature(const Cloud& cloud, double rho, std::span<const Index> queries,
                                   const Progress* progress = nullptr);

}  // namespace relievo::paper
