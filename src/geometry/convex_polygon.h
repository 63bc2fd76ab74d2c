// Convex polygons of the plane, counter-clockwise.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the polygon with every side moved inwards by `mm`, outwards if negative; sides that are shorter
// than 0.0001 mm then are left out. Neighbouring sides of the polygon are not parallel, and so much of it
// must remain that its sides still go all the way around.
std::vector<Vec2> inset(std::span<const Vec2> polygon, double mm);

}  // namespace relievo
