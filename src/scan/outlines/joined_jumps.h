// Joins depth jumps that continue each other.
#pragma once

#include <vector>

#include "scan/outlines/outlines.h"

namespace relievo {

// Joins two open jumps if one ends at most 4 rho before the other begins and both have the direction of the gap. Such
// gaps occur where the step in depth is close to the least step of a jump. Silhouettes and closed jumps stay as they
// are.
void join_jumps(std::vector<OutlineCurve>& outlines, double rho);

}  // namespace relievo
