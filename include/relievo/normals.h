// Normals of a scattered cloud: estimated where the file has none, turned where they point the wrong way.
#pragma once

#include <span>

#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Gives every point the normal of the plane through its `neighbours` nearest points (principal component
// analysis). The sign is left open: turn_to_viewer() fixes it. Does nothing to a cloud of fewer than 3
// points.
void estimate_normals(Cloud& cloud, std::size_t neighbours = 16);

// Turns every normal of a cloud in view coordinates to the viewer's side (z >= 0).
void turn_to_viewer(Cloud& viewed);

// The same for the points of `seen`, the visible ones, as far as they are seen well (z above 1/2). From these
// the signs spread to their neighbours, and so on: round an edge the surface goes on instead of folding back.
void turn_to_viewer(Cloud& viewed, const Spacing& spacing, std::span<const Index> seen);

// Whether the normals point into the model: seen from all six sides, most of the front-most points face away.
// A cloud scanned from one side alone is judged by the four sides across it. False without normals.
bool normals_point_inward(const Cloud& cloud);

// Reverses every normal.
void flip_normals(Cloud& cloud);

}  // namespace relievo
