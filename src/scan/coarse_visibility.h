// A fast, coarse estimate of the visible part of a cloud, which ranks views and checks normals. It is too
// coarse for reliefs. Also has functions that orient a cloud's normals. Tested by
// tests/scan/view_ranking_test.cpp, tests/scan/normals_test.cpp and tests/scan/surface_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"
#include "relievo/scan/view.h"

namespace relievo {

struct CoarseVisibility {
  // The share of the cells' front points whose normals face the viewer. Points that are seen nearly edge on
  // are not counted. The share is 0.5 if no points are left.
  double facing_share = .5;
  // The sum of the normal differences between neighbouring cells, without those across depth jumps.
  double normal_variation = 0;
  double one_layer =
      0;  // share of the cells in which the nearest and the farthest point belong to one surface
  // Above 0 if the shape of the front is that of an outside, below 0 if it is that of a hollow back. Needs no
  // signs of normals.
  double outside = 0;
};

// States whether a cloud's normals point out of the model or into it. With `unknown` each normal is turned to
// the viewer.
enum class NormalSigns { outward, inward, unknown };

// Returns one estimate for each view, in the order of the views. Each is made on a grid over the cloud in
// that view. The cells of the grid are at least as wide as a 160th of the diagonal of the cloud's box, and
// the front point of a cell is its point with the largest z. Crops are ignored. The cloud must have normals,
// or the results are the default.
std::vector<CoarseVisibility> coarse_visibility(const Cloud& cloud, std::span<const View> views,
                                                NormalSigns signs = NormalSigns::outward);

// Returns whether the normals of a model point into it, given the estimates for its six sides along the axes,
// see normals.h.
bool normals_point_inward(std::span<const CoarseVisibility> sides);

// The state of a cloud's normals before orient_normals(). Normals are usable if they point outwards, or if
// all face the viewer, as in a room scanned from inside.
enum class OriginalNormals { usable, missing, inward };

// Estimates the normals of a cloud in view coordinates if it has none, and reverses them if they point
// inwards. `cloud` is the same cloud in its own frame. Returns the state of its normals before.
OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud);

// Gives the estimated normals of a cloud in view coordinates consistent signs, such that the normals of
// visible points face the viewer.
void give_signs(Cloud& viewed, const Spacing& spacing);

// Returns whether the cloud was scanned from the viewer's side, as a depth image of a room is. Such a scan
// looks as if its normals pointed inwards, but if they were reversed, all of them would face away from the
// viewer.
bool all_face_viewer(const Cloud& viewed);

}  // namespace relievo
