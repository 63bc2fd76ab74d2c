// A fast, coarse estimate of what is visible of a cloud from +Z, to rank views and check normals. It is too
// coarse for reliefs. Tested by tests/scan/view_test.cpp and tests/scan/normals_test.cpp.
#pragma once

#include "relievo/scan/cloud.h"

namespace relievo {

struct CoarseVisibility {
  // The fraction that faces the viewer of those front points that are not seen edge on; 0.5 if there are
  // none.
  double facing_share = .5;
  // The sum of the normal differences between neighbouring cells, without those across depth jumps.
  double normal_variation = 0;
  double one_layer =
      0;             // share of the cells in which the nearest and the farthest point belong to one surface
  double bulge = 0;  // how much nearer the front is inside its outline than along it, over the box's diagonal
};

// Computes them from the front point, the one with the largest z, of each cell of a grid over a cloud in view
// coordinates. The diagonal of the cloud's box is `cells` cells long. Without normals the result is the
// default.
CoarseVisibility coarse_visibility(const Cloud& viewed, int cells = 160);

}  // namespace relievo
