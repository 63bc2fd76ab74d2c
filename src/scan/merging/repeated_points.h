// Points that repeat others, as in a scan that was exported twice and merged, or in a mesh whose faces each wrote their
// own corners. To every search for neighbours they would hide what is around a point.
// Tested by tests/scan/repeated_points_test.cpp.
#pragma once

#include <optional>

#include "geometry/neighbours.h"
#include "relievo/scan/cloud.h"

namespace relievo {

// See the function of this name in cloud.h. `tree` is that of the cloud. Returns nothing if hardly any points repeat others.
std::optional<Cloud> without_repeated_points(const Cloud& cloud, const KdTree<Vec3>& tree);

}  // namespace relievo
