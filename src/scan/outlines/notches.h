// Gaps between two surfaces. Tested by tests/scan/notches_test.cpp.
#pragma once

#include "relievo/scan/surface.h"

namespace relievo {

// Marks triangles as outside, from the silhouette inwards, that lie in the gap between a surface and another one behind
// it which turns away from the viewer there: nothing is seen between them.
void open_notches(Surface& surface);

}  // namespace relievo
