// Baselines whose heights are kept between 0 and the relief's height by a convex quadratic problem with
// bounds (solver::BoundedFit), solved with a tolerance of 1e-4. Tested by
// tests/relief/bounded_reliefs_test.cpp.
#pragma once

#include <vector>

#include "relievo/core/error.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Appearance mimicking for a viewer at infinity. Source: Schueller, Panozzo and Sorkine-Hornung,
// Appearance-mimicking surfaces, 2014.
//
// They move each vertex v_i = o + l_i d_i of the model along its ray d_i from the viewpoint o, from the
// distance L_i to l_i, so that the sum of w_i^2 A_i |n'_i - N_i|^2 over all vertices is least; n' and N are
// the normals of the new and of the old surface, A_i is the area around the vertex on the old one. They write
// a normal as the Laplacian of the positions over the mean curvature, take the model's own Laplacian K and
// curvature for both, and scale the model's part by l_i / L_i, as normals do not change when the whole
// surface moves along the rays:
//   minimise sum_i w_i^2 A_i |(K v)_i - (K V)_i l_i / L_i|^2   under given bounds of each l_i.
// Let the viewer be at o = (0, 0, R). For R -> infinity, with depths Z before and z after,
//   L_i = R - Z_i,   l_i = R - z_i,   l_i / L_i = 1 + (Z_i - z_i) / R + O(1 / R^2),
// so (x, y)_i = (X, Y)_i l_i / L_i -> (X, Y)_i: the first two components of the difference are O(1 / R). Its
// third component tends to (K z)_i - (K Z)_i. What remains is a thin plate on the model's own surface, which
// a smooth change of the depths bends:
//   minimise sum_i w_i^2 A_i ((K z)_i - (K Z)_i)^2   under 0 <= z_i <= h.
// K = A^-1 C has the cotangents C of the triangles in space.
//
// All points are visible, for which their w_i is 1. Their groups, pieces that move freely against each other,
// are here the pieces between depth jumps, where triangles are left out. A_i is a third of the triangles
// around the vertex. The silhouette lies on the ground, z = 0, as a scan has no surface behind it. A free
// silhouette above a wall has less shading on both scans on which it was tried.
Result<std::vector<double>> mimicking_heights(const Surface& surface, double height);

// An ablation of the layered method, not a published one: even compression by (5) with the same weight w_k at
// all points, and equation (9) under the bounds of the height. Its gamma is 0: it has no layers, no bending
// and no pull towards the order of near depths. `weight` is w_k, in [0, 1].
Result<std::vector<double>> bounded_heights(const Surface& surface, double height, double weight);

}  // namespace relievo
