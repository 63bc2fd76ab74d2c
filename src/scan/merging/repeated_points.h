// Points that repeat others, as in a scan that was exported twice and merged, or in a mesh whose faces each
// wrote their own corners. They would hide the surroundings of a point from every search for neighbours.
// Tested by tests/scan/repeated_points_test.cpp.
#pragma once

#include <optional>

#include "geometry/neighbours.h"
#include "relievo/scan/cloud.h"

namespace relievo {

// See the function of this name in cloud.h. `tree` is that of the cloud. Returns nothing if hardly any points
// repeat others.
std::optional<Cloud> without_repeated_points(const Cloud& cloud, const KdTree<Vec3>& tree);

}  // namespace relievo
