// A fast, coarse estimate of what is visible of a cloud, to rank views and check normals. It is too coarse for reliefs.
// Tested by tests/scan/view_ranking_test.cpp and tests/scan/normals_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/view.h"

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

// What is known of the normals' signs. Unknown ones are taken to face the viewer.
enum class NormalSigns { outward, inward, unknown };

// Returns them for each view, whose crop is not looked at: from the front point, the one with the largest z, of each cell
// of a grid over the cloud as the view turns it. The diagonal of the cloud's box is 160 cells long. Without normals the
// results are the default.
std::vector<CoarseVisibility> coarse_visibility(const Cloud& cloud, std::span<const View> views,
                                                NormalSigns signs = NormalSigns::outward);

// Returns whether normals point into a model that is seen so from the six sides along its axes, see normals.h.
bool normals_point_inward(std::span<const CoarseVisibility> sides);

}  // namespace relievo
