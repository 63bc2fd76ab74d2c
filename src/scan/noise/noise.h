// Measures the noise of a scan, and removes it without rounding creases.
#pragma once

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"
#include "scan/measure_with_tree.h"

namespace relievo {

// Returns the standard deviation of the points along their normals, in sampling distances. It is estimated
// from the scatter about local quadratic surfaces, for the quarter of the points that scatter least, so that
// detail in some parts of a model does not count. The result is lower if the normals scatter less than such
// noise implies. Scatter below 0.12 counts as detail, and the result is 0. It is also 0 for clouds with fewer
// than 100 points or without normals.
double measure_noise(const Cloud& cloud, const Spacing& spacing);

struct CleanPoints {
  std::vector<Vec3> points;
  std::vector<Vec3f> normals;
};

// States how much noise without_noise() removes, and at which points.
struct NoiseRemoval {
  double noise;  // > 0: standard deviation, in sampling distances
  std::span<const Index> points;
};

// Returns the points, in their order, each moved onto a surface that is fitted around it by robust
// regression, and the normals of these surfaces. More noise averages over wider neighbourhoods, and rounds
// sharper creases. Normals are fitted by linear functions in the tangent plane. Neighbours that deviate from
// the last fit, such as those beyond a crease, get less weight. Source: Oeztireli, Guennebaud and Gross,
// "Feature preserving point set surfaces based on non-linear kernel regression", 2009; they fit constant
// normals, which flattens curved parts. The cloud must have normals, and its rho must be greater than 0. The
// result is not usable once the progress is cancelled.
CleanPoints without_noise(const SearchableCloud& scan, const NoiseRemoval& removal, const Progress* progress);

// Returns the points that may be visible in a view once noise is removed: those that face the viewer or are turned
// away by little. Also returns three rings of neighbours, on which the curvature of these points depends. Indices
// ascend. `towards_viewer` is a unit vector. If it is 0, all points are returned.
std::vector<Index> points_near_front(std::span<const Vec3f> normals, const Vec3f& towards_viewer,
                                     const Spacing& spacing);

}  // namespace relievo
