// Estimates the normals of scattered points and determines their signs.
#pragma once

#include <span>

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns n with unit length; zero if n is zero or not finite. A vector that has unit length up to float
// rounding is returned unchanged, so that no bit changes when it is written to a file and read again.
Vec3f unit_normal(const Vec3& n);

// Gives every point the unit normal of the plane through its `neighbours` nearest points, at most 64
// (principal component analysis). If the cloud has axes, the normal also fits the axes of these neighbours.
// Points or axes, whichever scatter less there, have more influence. The sign is arbitrary until
// turn_to_viewer(). Does nothing to a cloud of fewer than 3 points. Once the progress is cancelled, the
// remaining normals are 0.
void estimate_normals(Cloud& cloud, std::size_t neighbours = 16, const Progress* progress = nullptr);

// Reverses the normals that face away from the viewer, so that all normals have z >= 0. The cloud is in view
// coordinates.
void turn_to_viewer(Cloud& viewed);

// Makes the signs of the normals consistent after turn_to_viewer(). `seen` are the visible points; those
// whose normals are within 60 degrees of the direction to the viewer keep their signs. From these points the
// signs spread from neighbour to neighbour, so that the surface continues around edges instead of folding
// back.
void spread_normal_signs(Cloud& viewed, const Spacing& spacing, std::span<const Index> seen);

// Returns whether the normals point into the model: on average over the six sides along the axes, less than a
// third of the front-most points have normals towards the viewer. If a cloud was scanned from one side only,
// this side and the opposite one cancel, and the other four sides decide. Returns false without normals.
bool normals_point_inward(const Cloud& cloud);

// Reverses every normal.
void flip_normals(Cloud& cloud);

}  // namespace relievo
