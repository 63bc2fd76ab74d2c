// Points at the same place, as one.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns for each point the lowest number of a point with exactly the same coordinates.
std::vector<Index> places(std::span<const Vec3> points);

}  // namespace relievo
