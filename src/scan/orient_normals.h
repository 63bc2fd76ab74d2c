// Gives a cloud outward normals, whatever normals its file has. Tested by tests/scan/surface_test.cpp.
#pragma once

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// The direction of a cloud's normals before orient_normals().
enum class OriginalNormals { outward, missing, inward };

// Estimates the normals of a cloud in view coordinates if it has none, and reverses them if they point
// inwards. `cloud` is the same cloud in its own frame. Returns what its normals were like before.
OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud);

}  // namespace relievo
