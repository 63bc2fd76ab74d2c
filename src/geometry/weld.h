// Welding of coincident points. Tested by tests/geometry/extent_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns for each point the lowest number of a point with exactly the same coordinates.
std::vector<Index> first_coincident(std::span<const Vec3> points);

}  // namespace relievo
