// Repairs triangles of a plate's front that are too thin for the single precision of files.
#pragma once

#include <span>

#include "relievo/plate/solid.h"

namespace relievo {

// Flips the longest edge of triangles that, seen from above, are hardly wider than the rounding of
// coordinates to single precision. Rounding could turn such triangles over or leave them without area. Such
// triangles arise where points of a hull are almost collinear. The solid must have only its front, without
// walls. A steep triangle whose flip would move the surface too far in z is kept, unless rounding turns it
// over. If `may_lose_edges`, triangles whose longest edge is on the front's boundary are removed, together
// with points that become unused. Returns the largest change of the surface in z.
double flip_thin_triangles(Solid& front, bool may_lose_edges = false);

// Returns the front's triangles that, seen from above, are not counter-clockwise after their coordinates are
// rounded as in files. If there are none and the outline does not intersect itself, the front in the file
// does not intersect itself either.
std::vector<Index> find_folds(const Solid& solid);

// Moves points of the front, and the points below them, by a few units in the last place. Afterwards find_folds()
// returns as few triangles as possible, usually none. Points of the outline and on the sides of the box do not move.
void unfold(Solid& solid, std::span<const Index> outline = {});

}  // namespace relievo
