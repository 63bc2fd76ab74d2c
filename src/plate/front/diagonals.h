// Turns the diagonals of rectangles along a surface. Tested by tests/plate/diagonals_test.cpp.
#pragma once

#include <span>

#include "relievo/core/types.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {

// The diagonals of rectangles in a Delaunay triangulation are arbitrary, and across a ridge they look like
// teeth. Gives each rectangle the diagonal along which the slope changes less, unless the slope of a corner
// is NaN. Changes only the triangles: the neighbours become invalid.
void turn_diagonals(std::span<const Vec2> points, std::span<const Vec2f> slopes, Triangulation& mesh);

}  // namespace relievo
