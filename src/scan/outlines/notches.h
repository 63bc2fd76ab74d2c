// Gaps between two surfaces. Tested by tests/scan/notches_test.cpp.
#pragma once

#include "relievo/scan/surface.h"

namespace relievo {

// Marks triangles in gaps as outside, from the silhouette inwards. Such a gap lies between a surface and
// another one behind it that turns away from the viewer there, so that nothing is seen between the two.
void open_notches(Surface& surface);

}  // namespace relievo
