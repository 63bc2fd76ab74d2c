// Turns the diagonals of rectangles along a surface. Tested by tests/plate/diagonals_test.cpp.
#pragma once

#include <span>

#include "relievo/core/types.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {

// The diagonals of rectangles in a Delaunay triangulation are arbitrary, and those across a ridge are teeth. Of each
// rectangle whose corners have slopes that are numbers, takes the diagonal along which the slope changes less. Changes
// the triangles alone: neighbours are no longer right.
void turn_diagonals(std::span<const Vec2> points, std::span<const Vec2f> slopes, Triangulation& mesh);

}  // namespace relievo
