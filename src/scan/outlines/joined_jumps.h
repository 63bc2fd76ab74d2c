// Joins depth jumps that continue each other.
#pragma once

#include <vector>

#include "scan/outlines/outlines.h"

namespace relievo {

// Joins open jumps where one ends up to 4 rho before another one begins and both lead across the gap. Where the
// depth differs by little more than a jump needs, a jump is found in pieces. Without joining, the surface would be
// torn between the ends of two pieces. Silhouettes and closed jumps stay as they are.
void join_jumps(std::vector<OutlineCurve>& outlines, double rho);

}  // namespace relievo
