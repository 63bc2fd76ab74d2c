// Gives a cloud normals that a relief can be made from. Tested by tests/scan/surface_test.cpp.
#pragma once

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// The state of a cloud's normals before orient_normals(). Normals are usable if they point outwards, or if
// all face the viewer, as in a room scanned from inside.
enum class OriginalNormals { usable, missing, inward };

// Estimates the normals of a cloud in view coordinates if it has none, and reverses them if they point
// inwards. `cloud` is the same cloud in its own frame. Returns what its normals were like before.
OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud);

// Gives the estimated normals of a cloud in view coordinates consistent signs, such that the visible ones
// face the viewer.
void give_signs(Cloud& viewed, const Spacing& spacing);

// Returns whether the cloud was scanned from the viewer's side, as a depth image of a room is. Such a scan
// looks as if its normals pointed inwards, but if they were reversed, all of them would face away from the
// viewer.
bool all_face_viewer(const Cloud& viewed);

}  // namespace relievo
