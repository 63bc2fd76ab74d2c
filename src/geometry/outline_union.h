// The boundary of what closed outlines cover, as glyphs and drawings give them. Tested by
// tests/geometry/outline_union_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "geometry/segment_grid.h"
#include "relievo/core/types.h"

namespace relievo {

// Closed polygons without their last side; together they cover where their winding number is not 0.
using Outlines = std::vector<std::vector<Vec2>>;

// Returns how often the outlines go around the place, counter-clockwise.
int winding_number(const Outlines& outlines, const Vec2& place);

// Returns the sides of the area that the outlines cover, which lies to the left of each. Sides may only meet at
// their ends. Corners are rounded to a millionth of the unit. Sides inside the area are left out, so that
// outlines may overlap.
std::vector<Segment> union_boundary(const Outlines& outlines);

}  // namespace relievo
