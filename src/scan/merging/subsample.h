// Subsampling of a cloud to an even, coarser spacing.
#pragma once

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns a subset of the points of a cloud with normals whose spacing, as measured by measure_spacing(), is
// about `wanted`. Each has the mean normal and colour of the points it represents. `spacing` is that of the
// cloud; its rho must be smaller than `wanted`. Takes O(n log n). The result depends on the order of the
// points.
Cloud subsample(const Cloud& cloud, const Spacing& spacing, double wanted);

}  // namespace relievo
