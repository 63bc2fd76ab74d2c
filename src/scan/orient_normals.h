// Gives a cloud normals that a relief can be made from. Tested by tests/scan/surface_test.cpp.
#pragma once

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// The normals of a cloud before orient_normals(). Usable are outward ones, and those of a room scanned from inside.
enum class OriginalNormals { usable, missing, inward };

// Estimates the normals of a cloud in view coordinates if it has none, and reverses them if they point
// inwards. `cloud` is the same cloud in its own frame. Returns what its normals were like before.
OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud);

}  // namespace relievo
