// Leaves out the table or background that a figure stands on or before. Tested by
// tests/scan/support_plane_test.cpp.
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

// Removes from the shown points those of the plane, of pieces that stay low over it, and of debris. Removes
// from the cloud the outlines in the plane.
void leave_out_plane(const SupportPlane& plane, const Spacing& spacing, Cloud& cloud,
                     const ShownPoints& shown);

}  // namespace relievo
