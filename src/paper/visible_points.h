// Finds the visible points of a cloud (section 3.2 of the paper).
#pragma once

#include <vector>

#include "relievo/scan/cloud.h"

namespace relievo::paper {

// Returns the indices of the visible points of a cloud in view coordinates, in ascending order. The view
// plane is divided into square cells with sides of 2 rho. A point is visible if it is less than 2 rho below
// the highest point of its cell and its normal faces the viewer; a height field cannot have other normals.
// `rho` is the sampling distance, > 0.
std::vector<Index> visible_points(const Cloud& viewed, double rho);

}  // namespace relievo::paper
