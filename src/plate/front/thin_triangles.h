// Triangles of a plate's front that are too thin for the single precision of files.
// Tested by thin_triangles_test.
#pragma once

#include "relievo/plate/solid.h"

namespace relievo {

// Flips the longest edges of triangles that, seen from above, are hardly thicker than the rounding of
// coordinates to single precision. Once rounded, such triangles could be turned over or have no area. The
// solid must have only its front, without walls. Thin triangles arise where points of a hull are almost on
// one line. Returns the largest change of the surface in z. Steep triangles, where it would change much, stay
// unless rounding does turn them over. Triangles whose longest edge is on the front's boundary are removed if
// `may_lose_edges`, together with points that nothing else uses.
double flip_thin_triangles(Solid& front, bool may_lose_edges = false);

}  // namespace relievo
