// Mean curvature of the surface through a scattered cloud (stage 4), paper's equations (2) and (3).
#pragma once

#include <span>
#include <vector>

#include "relievo/geometry/triangulation.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

enum class CurvatureMethod {
  // Half the divergence of the normals, fitted linearly in the tangent plane: exact for spheres and
  // cylinders, and
  // several times less noisy on scattered points than (3), whose second derivatives see how unevenly they
  // lie.
  normal_fit,
  // Equations (2) and (3) in closed form, at the point's projection onto the moving-least-squares surface g =
  // 0.
  // Source: Yang and Qian, Direct computing of surface curvatures for point-set surfaces, 2007.
  mls_surface,
};

struct CurvatureOptions {
  CurvatureMethod method = CurvatureMethod::normal_fit;
  double scale = 2;  // width h of the weight, about exp(-d^2 / h^2), in local spacings; more is smoother
};

// Returns the mean curvature, 1/length, convex positive, at the points numbered by `queries`, clamped to 1 /
// rho. Neighbours whose normals face away (the other side of a thin wall) do not count. 0 where there are too
// few neighbours. Needs unit normals. See docs/decisions/curvature.md for the two methods measured.
std::vector<double> mean_curvature(const Cloud& cloud, const Spacing& spacing, std::span<const Index> queries,
                                   const CurvatureOptions& options = {});

// Returns the values averaged over each point's neighbours in the view plane, up to about 2 rho away, each
// weighted by the area it stands for there. Where the front stops short of what lies behind it, points of
// both alternate in the plane: an amount added to heights by the one's and the other's curvature would show
// as specks along the edge.
std::vector<double> average_in_plane(std::span<const double> values, std::span<const Vec2> points,
                                     std::span<const Vec3f> normals, const Triangulation& triangulation,
                                     double rho);

struct NormalisedCurvature {
  std::vector<float> k;  // in [-1, 1]
  double delta = 0;      // standard deviation of |k|; 0 for a surface without curvature
  double unit = 0;       // k times this is the mean curvature, where it was not clipped
};

// Divides by the 99th percentile of the absolute values and clips, so that k and delta are dimensionless.
NormalisedCurvature normalise(std::span<const double> mean_curvature);

}  // namespace relievo
