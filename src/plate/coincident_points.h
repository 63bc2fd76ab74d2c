// Finds and separates points of a solid that coincide once a file has rounded them to single precision. Dense
// scans sometimes contain such pairs. Tested by solid_test.
#pragma once

#include <array>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// Returns the pairs of used points that coincide in single precision; the second has the higher index.
std::vector<std::array<Index, 2>> find_coincident_points(const Solid& solid);

// Moves the second point of each pair that find_coincident_points() finds towards `middle_z`, by the smallest
// steps of single precision that separate the pair. In this direction the solid's box does not grow.
void separate_coincident(Solid& solid, double middle_z);

}  // namespace relievo
