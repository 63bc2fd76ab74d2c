// Samples of the regions around control points.
#pragma once

#include <span>
#include <vector>

#include "relievo/relief/control_points.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Returns `per_region` points for each control point in turn, from the points nearest to it. Each represents
// the same area in the view plane; in small regions some points are repeated.
std::vector<Index> sample_regions(const Surface& surface, const ControlPoints& control,
                                  std::size_t per_region);

}  // namespace relievo
