// Convex polygons of the plane, with counter-clockwise corners.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the polygon with every side moved inwards by `mm`, outwards if negative. Sides that are then
// shorter than 0.0001 mm are removed. Neighbouring sides of the polygon must not be parallel, and the polygon
// must not vanish: its remaining sides must still go all the way around.
std::vector<Vec2> inset(std::span<const Vec2> polygon, double mm);

// Returns whether the point `place` lies inside the convex polygon, at least `depth` from its sides.
bool is_within(const Vec2& place, std::span<const Vec2> polygon, double depth = 0);

}  // namespace relievo
