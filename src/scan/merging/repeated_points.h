// Merges repeated points, which occur in a scan that was exported twice, or in a mesh file in which each face has its
// own copies of its corners. Among repeated points, a search for neighbours would find only a point's copies instead
// of its surroundings.
#pragma once

#include <optional>

#include "geometry/neighbours.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Does the same as without_repeated_points() in cloud.h; `tree` contains the points of the cloud. Returns
// nothing if hardly any points are repeated.
std::optional<Cloud> without_repeated_points(const Cloud& cloud, const KdTree<Vec3>& tree);

// Returns a subset of the points of a cloud with normals. The spacing of the subset, as measured by
// measure_spacing(), is about `wanted`. Each point has the mean normal and colour of the points that it
// represents. `spacing` is the spacing of the cloud; its rho must be smaller than `wanted`. Takes O(n log n).
// The result depends on the order of the points.
Cloud subsample(const Cloud& cloud, const Spacing& spacing, double wanted);

}  // namespace relievo
