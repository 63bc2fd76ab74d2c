// Insets convex polygons in the plane, and tests whether places are inside. Corners are counter-clockwise.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// Returns the polygon after every side was moved inwards by `mm`. A negative `mm` moves the sides outwards.
// Sides that become shorter than 0.0001 mm are removed. Neighbouring sides of the polygon must not be
// parallel, and the remaining sides must still enclose an area.
std::vector<Vec2> inset(std::span<const Vec2> polygon, double mm);

// Returns whether `place` is inside the convex polygon and at least `depth` away from its sides.
bool is_within(const Vec2& place, std::span<const Vec2> polygon, double depth = 0);

}  // namespace relievo
