// Computes the mean curvature of the surface through scattered points (stage 4).
#pragma once

#include <span>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/geometry/triangulation.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

struct CurvatureOptions {
  // The width h of the neighbours' weights, about exp(-d^2 / h^2), in local spacings, > 0; larger is
  // smoother.
  double scale = 2;
};

// Returns the mean curvature at the points with the indices `queries`, in 1 / length. It is positive where
// the surface is convex, and clamped to [-1 / rho, 1 / rho]. The mean curvature is half the divergence of a
// linear function that is fitted to the normals in the tangent plane. This is exact on spheres and cylinders.
// On scattered points it is several times less noisy than the paper's equations (2) and (3), whose second
// derivatives depend on the distribution of the points (docs/decisions/curvature.md). Neighbours on the other
// side of a thin wall, whose normals face away, are ignored. Returns 0 where there are too few neighbours,
// and everywhere if the cloud has no normals. Normals must have unit length. After cancellation, returns
// early with meaningless values.
std::vector<double> mean_curvature(const Cloud& cloud, const Spacing& spacing, std::span<const Index> queries,
                                   const CurvatureOptions& options = {}, const Progress* progress = nullptr);

// Returns the average of the values over each point's neighbours in the view plane, weighted by the area that
// each neighbour represents there. Three passes over the triangulation's edges with weights of exp(-(length /
// rho)^2) spread a value by 1.5 rho (root mean square). At a depth jump, points of the surface in front and
// points of the surface behind it alternate in the plane. Without the average, their different curvatures
// would be visible as specks along the edge.
std::vector<double> average_in_plane(std::span<const double> values, std::span<const Vec2> points,
                                     std::span<const Vec3f> normals, const Triangulation& triangulation,
                                     double rho);

struct NormalisedCurvature {
  std::vector<float> k;  // per point: normalised mean curvature, in [-1, 1]
  double delta = 0;      // standard deviation of |k|; 0 for a surface without curvature
  double unit = 0;       // the mean curvature that k = 1 represents; larger ones were clipped
};

// Divides the curvatures by the 99th percentile of their absolute values and clips them to [-1, 1], so that k
// and delta have no unit. If there are no values or that percentile is 0, delta and unit are 0.
NormalisedCurvature normalise(std::span<const double> mean_curvature);

}  // namespace relievo
