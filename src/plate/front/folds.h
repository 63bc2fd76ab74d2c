// Triangles that are turned over once a file has rounded their corners to single precision.
// Tested by tests/plate/folds_test.cpp.
#pragma once

#include <span>

#include "relievo/plate/solid.h"

namespace relievo {

// Returns the triangles of the front that are not counter-clockwise, seen from above, with coordinates as
// files store them. If there are none, and the outline does not intersect itself, neither does the stored
// front.
std::vector<Index> find_folds(const Solid& solid);

// Moves points of the front, together with those below them, by a few units in the last place until
// find_folds() finds none, or as few as it can. The points of the outline, and those on the sides of the box,
// stay.
void unfold(Solid& solid, std::span<const Index> outline = {});

}  // namespace relievo
