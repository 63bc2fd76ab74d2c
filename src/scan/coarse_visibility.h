// A fast, coarse estimate of the visible part of a cloud, for ranking views and checking normals. It is too
// coarse for reliefs. Also functions that orient a cloud's normals. Tested by
// tests/scan/view_ranking_test.cpp, tests/scan/normals_test.cpp and tests/scan/surface_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"
#include "relievo/scan/view.h"

namespace relievo {

struct CoarseVisibility {
  // The share of the cells' front points whose normals face the viewer. Points seen nearly edge-on are not
  // counted. The share is 0.5 if all points are seen so.
  double facing_share = .5;
  // The sum of the differences between the normals of neighbouring cells, except across depth jumps.
  double normal_variation = 0;
  double one_layer = 0;  // share of the cells whose nearest and farthest points belong to one surface
  // Positive if the visible surface has the shape of an outside, negative if it has that of a hollow back.
  // Does not depend on the signs of normals.
  double outside = 0;
};

// Whether a cloud's normals point out of the model or into it. If `unknown`, each normal is turned to the
// viewer.
enum class NormalSigns { outward, inward, unknown };

// Returns an estimate for each view, in the order of the views. Estimates use a grid over the cloud in that
// view. Its cells are at least as wide as a 160th of the diagonal of the cloud's box; the front point of a
// cell is its point with the largest z. Crops are ignored. Without normals the results are default values.
std::vector<CoarseVisibility> coarse_visibility(const Cloud& cloud, std::span<const View> views,
                                                NormalSigns signs = NormalSigns::outward);

// Returns whether the normals of a model point into it. `sides` are the estimates for its six sides along the
// axes, see normals.h.
bool normals_point_inward(std::span<const CoarseVisibility> sides);

// The state of a cloud's normals before orient_normals(). Normals are usable if they point outwards, or if
// all of them face the viewer, as in a room scanned from inside.
enum class OriginalNormals { usable, missing, inward };

// Estimates the normals of a cloud in view coordinates if it has none, and reverses them if they point
// inwards. `cloud` is the same cloud in its own axes. Returns the previous state of the normals.
OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud);

// Gives the estimated normals of a cloud in view coordinates consistent signs: the normals of visible points
// face the viewer.
void give_signs(Cloud& viewed, const Spacing& spacing);

// Returns whether all normals face the viewer, as in a depth image of a room. Such normals seem to point
// inwards, but if they were reversed, all would face away from the viewer.
bool all_face_viewer(const Cloud& viewed);

// A direction of view. `towards_viewer` points from the model to the viewer, `up` upwards in the view. They
// are perpendicular unit vectors.
struct Side {
  Vec3 towards_viewer, up;
};

// Returns the side of the scan if a single view shows everything that was scanned; nothing if the cloud has
// several layers from every direction.
// - The view is along an axis of the file if the scan's own direction is close to it, otherwise along that
// direction. It never shows the hollow back. Signed normals decide that; without them, the shape and a
// possible camera at the file's origin.
// - Up is Y, or Z in views along Y. In files of cameras that look along +Z, up is -Y. If the outline has a
// broad straight foot on another side, that side is down.
// The cloud must have normals and no outliers.
std::optional<Side> scanned_side(const Cloud& cloud, NormalSigns signs);

}  // namespace relievo
