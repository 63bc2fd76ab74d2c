// Finds the exact outlines of a mesh in a view.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"

namespace relievo {

// Returns the outlines of a mesh in view coordinates: the parts of its edges that separate the visible
// surface from nothing, or from a surface more than `pixel` behind it. All triangles must be
// counter-clockwise, as seen by the viewer. Where another surface hides a part of an edge, the end of the
// visible part is accurate to half a pixel.
std::vector<OutlineSegment> seen_outlines(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                          double pixel);

}  // namespace relievo
