// Computes the boundary of the union of closed outlines, such as those of glyphs and drawings.
#pragma once

#include <vector>

#include "geometry/segment_grid.h"
#include "relievo/core/types.h"

namespace relievo {

// Closed polygons; the first corner is not repeated. Their union is the area where their winding number is
// not 0.
using Outlines = std::vector<std::vector<Vec2>>;

// Returns how often the outlines go counter-clockwise around `place`.
int winding_number(const Outlines& outlines, const Vec2& place);

// Returns the sides of the outlines' union, which lies on the left of each side. Sides meet only at their
// ends. Corners are rounded to a millionth of the unit. Outlines may overlap: sides inside the union are left
// out.
std::vector<Segment> union_boundary(const Outlines& outlines);

}  // namespace relievo
