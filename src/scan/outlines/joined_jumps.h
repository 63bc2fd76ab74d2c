// Joins depth jumps that continue each other.
#pragma once

#include <vector>

#include "scan/outlines/outlines.h"

namespace relievo {

// Joins open jumps if one ends at most 4 rho before another one begins and both lead across the gap. Such gaps occur
// where the step in depth is close to the least step of a jump; the surface would be torn there. Silhouettes and
// closed jumps stay as they are.
void join_jumps(std::vector<OutlineCurve>& outlines, double rho);

}  // namespace relievo
