// Finds the direction from which a one-sided scan was taken, for rank_views() in view.h.
#pragma once

#include <optional>

#include "relievo/scan/cloud.h"
#include "scan/coarse_visibility.h"

namespace relievo {

// A direction of view. `towards_viewer` points from the model to the viewer. `up` points upwards in the view.
// They are perpendicular unit vectors.
struct Side {
  Vec3 towards_viewer, up;
};

// Returns the side of the scan if a single view shows everything that was scanned; nothing if the cloud has several
// layers from every direction.
// - The view is along the direction of the scan or, if an axis of the file is close to that direction, along the axis.
// It never shows the hollow back. The back is recognised by the signs of the normals. If they are unknown, it is
// recognised by its shape, and by whether a camera at the file's origin could have seen the cloud.
// - Up is Y, or Z in views along Y. In files of cameras that look along +Z, up is -Y. If the outline has a broad
// straight foot on another side, that side is down.
// The cloud must have normals and no outliers.
std::optional<Side> scanned_side(const Cloud& cloud, NormalSigns signs);

}  // namespace relievo
