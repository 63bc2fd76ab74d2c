// The exact outlines of a mesh in a view. Tested by tests/scan/mesh_outlines_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/cloud.h"

namespace relievo {

// Returns the outlines of a mesh in view coordinates: the parts of its edges where the visible surface
// borders on nothing, or on a surface that lies more than `pixel` behind it. All triangles must be
// counter-clockwise as seen. Where an outline passes behind another surface, its end is within half a pixel
// of the true place.
std::vector<OutlineSegment> seen_outlines(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                          double pixel);

}  // namespace relievo
