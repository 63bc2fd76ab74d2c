// Repairs triangles of a plate's front that are too thin for the single precision of files. Tested by
// thin_triangles_test.
#pragma once

#include <span>

#include "relievo/plate/solid.h"

namespace relievo {

// Flips the longest edges of triangles that, seen from above, are hardly thicker than the rounding of
// coordinates to single precision. Once rounded, such triangles could be turned over or have no area. They
// arise where points of a hull are almost on one line. The solid must have only its front, without walls.
// Returns the largest change of the surface in z. Steep triangles, at which the surface would change much,
// stay unless rounding turns them over. Triangles whose longest edge is on the front's boundary are removed
// if `may_lose_edges`, together with points that nothing else uses.
double flip_thin_triangles(Solid& front, bool may_lose_edges = false);

// Returns the triangles of the front that are not counter-clockwise, seen from above, with coordinates as
// files store them. If there are none, and the outline does not intersect itself, the stored front does not
// intersect itself, either.
std::vector<Index> find_folds(const Solid& solid);

// Moves points of the front, together with those below them, by a few units in the last place until
// find_folds() finds none, or as few as it can. The points of the outline, and those on the sides of the box,
// stay.
void unfold(Solid& solid, std::span<const Index> outline = {});

}  // namespace relievo
