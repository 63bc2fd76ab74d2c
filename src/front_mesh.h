// The front of a scattered cloud as triangles, to take points between its points.
#pragma once

#include "relievo/mesh.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns the triangles between the visible points of a cloud with normals in view coordinates: those of its
// relief. Where the depth jumps, the triangle between is shared out among its corners, each of which goes on
// as its normal says; wider ones, over narrow holes that the relief closes, show nothing. Empty if nothing is
// seen.
Mesh front_mesh(const Cloud& viewed, const Spacing& spacing);

}  // namespace relievo
