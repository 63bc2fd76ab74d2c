// Fewer points of the same surface.
#pragma once

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns points of a cloud with normals that are about `wanted` apart, in the sense of measure_spacing(),
// each with the mean normal and colour of those that it stands for. `spacing` is the cloud's, smaller than
// that. Time n log n. Depends on the order of the points.
Cloud thinned(const Cloud& cloud, const Spacing& spacing, double wanted);

}  // namespace relievo
