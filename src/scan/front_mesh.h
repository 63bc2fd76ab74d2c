// Makes a triangle mesh of the visible side of a cloud, from which more points can be sampled.
#pragma once

#include "relievo/scan/mesh.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns a mesh of the cloud's visible points, triangulated as for a relief of the cloud. The cloud has normals and
// is in view coordinates. A triangle across a depth jump is divided into three parts, one in the tangent plane of each
// corner. Wide triangles over narrow holes get the normal (0, 0, 1). The mesh is empty if no point is visible.
Mesh front_mesh(const Cloud& viewed, const Spacing& spacing);

}  // namespace relievo
