// Points that a file could not tell apart.
#pragma once

#include <array>
#include <vector>

#include "relievo/plate/solid.h"

namespace relievo {

// Returns the pairs of used points that single precision cannot tell apart; the second has the higher index.
std::vector<std::array<Index, 2>> find_twins(const Solid& solid);

// Lifts points apart that would become one in a file, by the smallest step of single precision, towards the
// middle height so that the box stays. Dense scans hold such pairs now and then.
void separate_twins(Solid& solid, double middle_z);

}  // namespace relievo
