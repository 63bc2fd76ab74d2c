// A triangle mesh of the visible side of a scattered cloud. It serves to sample points between those of the
// cloud.
#pragma once

#include "relievo/scan/mesh.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns the triangles that the relief of a cloud would have: a triangulation of its visible points. The
// cloud has normals and is in view coordinates. A triangle across a depth jump is divided among its corners,
// and each part continues its corner's tangent plane. Wide triangles over narrow holes get the normal (0, 0,
// 1). Empty if no point is visible.
Mesh front_mesh(const Cloud& viewed, const Spacing& spacing);

}  // namespace relievo
