// Triangles of a plate's front that are too thin for the single precision of files.
// Tested by thin_triangles_test.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Flips the longest edges of triangles, seen from above, that are about as thin as coordinates are rounded in single
// precision: rounded, they could be turned over or have no area. All triangles must be the front's, without walls. Such
// triangles arise where points of a hull are almost on one line. Returns how far in z the surface moves at most; triangles
// that are steep, so that it would move far, stay unless rounding does turn them over. Those whose longest edge is an edge
// of the front are removed if it `may_lose_edges`, with points that nothing else uses.
double flip_thin_triangles(Solid& front, bool may_lose_edges = false);

}  // namespace relievo
