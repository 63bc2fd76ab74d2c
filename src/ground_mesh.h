// Ground that follows a curved surface, in triangles of an even size.
#pragma once

#include <span>
#include <vector>

#include "bend.h"
#include "relievo/plate/solid.h"

namespace relievo {

// Is the place inside the convex polygon, and so far from its sides?
bool is_within(const Vec2& place, std::span<const Vec2> polygon, double depth = 0);

// Returns how far apart points at height z within the convex polygon may lie so that triangles of them, bent,
// are about within the tolerance. No less than what makes 200,000 points, and at most a quarter of the
// polygon's box.
double ground_spacing(const Bend& bend, std::span<const Vec2> polygon, double z, double tolerance_mm);

// Returns the convex polygon with points between its corners, `spacing` apart at most. They lie outwards of
// its sides by up to 0.00001 mm, so that all are corners.
std::vector<Vec2> subdivided(std::span<const Vec2> polygon, double spacing);

// Covers what lies within the loop, whose corners are convex, with flat triangles that look down, through
// points `spacing` apart.
void fill_below(Solid& solid, const Loop& loop, double spacing);

// Adds the points of the convex polygon `foot` to the placed front, and others between it and the relief,
// `spacing` apart, at the height of the ground, and covers all within the polygon: the relief's triangles
// stay but where that is not Delaunay's choice, the rest becomes ground. `front` is the same before it was
// placed. Returns the foot's points; none, with nothing changed, if the relief's triangles are not
// Delaunay's.
Loop fill_ground(Solid& placed, const Front& front, std::span<const Vec2> foot, double spacing);

}  // namespace relievo
