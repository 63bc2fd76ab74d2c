// What all rivals end with.
#pragma once

#include <span>

#include "relievo/relief.h"

namespace relievo {

// Puts the boundary points on the base and scales to the height.
Relief scaled_relief(std::vector<double> heights, const Surface& surface, double height);

// Every point's depth above the deepest.
std::vector<double> depths(const Surface& surface);

}  // namespace relievo
