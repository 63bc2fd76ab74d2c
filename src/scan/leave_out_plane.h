// Leaves a table or a background out of what is seen. Tested by tests/scan/support_plane_test.cpp.
#pragma once

#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"
#include "relievo/scan/support_plane.h"

namespace relievo {

// The numbers of a cloud's points that are shown.
struct ShownPoints {
  std::vector<Index>& visible;
  std::vector<Index>& hole_fill;
};

// Leaves out the points of the plane, pieces that stay low over it, and the exact outlines in it.
void leave_out_plane(const SupportPlane& plane, const Spacing& spacing, Cloud& cloud,
                     const ShownPoints& shown);

}  // namespace relievo
