// Finds and separates points of a solid that coincide in a file's single precision. Dense scans sometimes
// contain such points. Tested by solid_test.
#pragma once

#include <array>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// Returns the points as files store them, rounded to single precision. The result consists of floats,
// because g++ 12 removes the rounding in double(float(x)) when it vectorises.
std::vector<Vec3f> stored_points(const Solid& solid);

// Returns the pairs of used points that coincide in single precision. The second index of a pair is the
// higher one.
std::vector<std::array<Index, 2>> find_coincident_points(const Solid& solid);

// Separates each pair of find_coincident_points(). Moves the pair's second point towards `middle_z`, by the
// smallest number of steps of single precision that separates the pair. A move towards the middle cannot
// enlarge the solid's box.
void separate_coincident(Solid& solid, double middle_z);

}  // namespace relievo
