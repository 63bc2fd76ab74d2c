// The visible points of a cloud (section 3.2 of the paper).
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"

namespace relievo::paper {

// Returns the indices of the visible points of a cloud in view coordinates, in ascending order. The view plane
// is divided into square cells whose side is 2 rho; in each cell those points are visible that lie less than
// 2 rho below its highest one. Of these, points whose normals do not face the viewer are left out, because no
// height field has such normals. `rho` is the sampling distance, > 0.
std::vector<Index> visible_points(const Cloud& viewed, double rho);

}  // namespace relievo::paper
