// Finds the side from which a one-sided scan was taken, for rank_views() in view.h. Tested by
// tests/scan/scanned_side_test.cpp.
#pragma once

#include <optional>

#include "relievo/scan/cloud.h"
#include "scan/coarse_visibility.h"

namespace relievo {

// A frame of view: `towards_viewer` points from the model to the viewer, `up` upwards in the view. Both are of
// unit length and at right angles to each other.
struct Side {
  Vec3 towards_viewer, up;
};

// Returns the side of the scan if one view shows everything that was scanned; none if the cloud has several
// layers from everywhere.
// - The view is along an axis of the file if the scan nearly looks along it, otherwise along the scan's own
//   direction. It is never the hollow back: normals with signs tell it, otherwise the shape, and whether the
//   file's origin is where a camera may have been.
// - Upwards is Y, and Z in views along Y. In the frames of cameras that look along +Z, -Y is upwards. If the
//   outline has a broad straight foot on another side, it stands on that.
// The cloud must have normals and no outliers.
std::optional<Side> scanned_side(const Cloud& cloud, NormalSigns signs);

}  // namespace relievo
