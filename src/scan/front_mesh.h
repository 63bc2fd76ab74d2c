// A triangle mesh of the visible side of a scattered cloud, from which points between its points can be
// sampled.
#pragma once

#include "relievo/scan/mesh.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns a triangulation of the visible points of a cloud with normals, in view coordinates: the triangles
// that its relief would have. A triangle across a depth jump is divided among its corners, and each part
// continues its corner's tangent plane. Wide triangles over narrow holes get the normal (0, 0, 1). Empty if
// no point is visible.
Mesh front_mesh(const Cloud& viewed, const Spacing& spacing);

}  // namespace relievo
