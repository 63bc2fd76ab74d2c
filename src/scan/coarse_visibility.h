// Estimates the visible part of a cloud fast and coarsely, for ranking views and checking normals; the estimate is
// too coarse for reliefs. Also orients a cloud's normals. Tested by tests/scan/view_ranking_test.cpp,
// tests/scan/normals_test.cpp and tests/scan/surface_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"
#include "relievo/scan/view.h"

namespace relievo {

struct CoarseVisibility {
  // The share of cells whose front point has a normal that faces the viewer. Front points seen nearly edge-on
  // are not counted; if no point is counted, the share is 0.5.
  double facing_share = .5;
  // The sum of the differences between the normals of neighbouring cells, except across depth jumps.
  double normal_variation = 0;
  double one_layer = 0;  // share of the cells whose nearest and farthest points belong to one surface
  // Positive if the visible surface has the shape of an outside, negative if it has the shape of a hollow
  // back. Does not depend on the signs of normals.
  double outside = 0;
};

// Whether a cloud's normals point out of the model or into it. If `unknown`, each normal is turned to the
// viewer.
enum class NormalSigns { outward, inward, unknown };

// Returns an estimate for each view, in the order of the views. Each estimate uses a grid over the cloud as
// seen in its view. The cells of the grid are at least as wide as a 160th of the diagonal of the cloud's box;
// the front point of a cell is its point with the largest z. Crops are ignored. Without normals the results
// are default values.
std::vector<CoarseVisibility> coarse_visibility(const Cloud& cloud, std::span<const View> views,
                                                NormalSigns signs = NormalSigns::outward);

// Returns whether the normals of a model point into it. `sides` are the estimates for its six sides along the
// axes, see normals.h.
bool normals_point_inward(std::span<const CoarseVisibility> sides);

// The state of a cloud's normals before orient_normals(). Normals are usable if they point outwards, or if
// all of them face the viewer, as in a room scanned from inside.
enum class OriginalNormals { usable, missing, inward };

// Estimates the normals of a cloud in view coordinates if it has none, and reverses its normals if they point
// inwards. `cloud` is the same cloud before it was turned into the view. Returns the state of the normals before the
// call.
OriginalNormals orient_normals(Cloud& viewed, const Spacing& spacing, const Cloud& cloud);

// Makes the signs of estimated normals consistent, so that the normals of visible points face the viewer. The cloud
// is in view coordinates.
void give_signs(Cloud& viewed, const Spacing& spacing);

// Returns whether all normals face the viewer, as in a depth image of a room. Such normals seem to point
// inwards, but if they were reversed, all would face away from the viewer.
bool all_face_viewer(const Cloud& viewed);

// A direction of view. `towards_viewer` points from the model to the viewer. `up` points upwards in the view.
// They are perpendicular unit vectors.
struct Side {
  Vec3 towards_viewer, up;
};

// Returns the side of the scan if a single view shows everything that was scanned; nothing if the cloud has several
// layers from every direction.
// - The view is along the direction of the scan or, if an axis of the file is close to that direction, along
// the axis. It never shows the hollow back. The back is recognised by the signs of the normals. If the signs
// are unknown, the back is recognised by its shape, and by whether a camera at the file's origin could have
// seen the cloud.
// - Up is Y, or Z in views along Y. In files of cameras that look along +Z, up is -Y. If the outline has a broad
// straight foot on another side, that side is down.
// The cloud must have normals and no outliers.
std::optional<Side> scanned_side(const Cloud& cloud, NormalSigns signs);

}  // namespace relievo
