// Finds lines inside a surface along which it bends or steps within a sampling distance, such as eyelids, lips, hems
// and creases.
#pragma once

#include <vector>

#include "scan/outlines/outlines.h"

namespace relievo {

// Adds inner lines to the outlines of a surface, as jumps with the higher side on the left. Jumps that end inside the
// surface are continued as long as the surface bends or steps. Lines keep a distance of 2 rho from other outlines.
// New lines shorter than 8 rho are left out.
void add_inner_lines(const Surface& surface, const PlanePoints& plane, std::vector<OutlineCurve>& outlines);

}  // namespace relievo
