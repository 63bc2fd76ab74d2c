// Declares baselines whose heights are kept between 0 and the relief's height. Each solves a convex
// quadratic problem with bounds (solver::BoundedFit) with a tolerance of 1e-4.
#pragma once

#include <vector>

#include "relievo/core/error.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Appearance mimicking for a viewer at infinity. Source: Schueller, Panozzo and Sorkine-Hornung,
// Appearance-mimicking surfaces, 2014.
//
// The paper moves each vertex v_i = o + l_i d_i of the model along its ray d_i from the viewpoint o. The
// distance of the vertex from o changes from L_i to l_i. The paper minimises the sum of
// w_i^2 A_i |n'_i - N_i|^2 over all vertices. n' and N are the normals of the new and of the old surface, and
// A_i is the area around the vertex on the old one. A normal is the Laplacian of the positions divided by the
// mean curvature. The paper uses the Laplacian K and the curvature of the old surface for both normals. It
// scales the old term by l_i / L_i, because normals do not change when the whole surface moves along the
// rays:
//   minimise sum_i w_i^2 A_i |(K v)_i - (K V)_i l_i / L_i|^2   under given bounds of each l_i.
// Let the viewer be at o = (0, 0, R). For R -> infinity, with depths Z before and z after,
//   L_i = R - Z_i,   l_i = R - z_i,   l_i / L_i = 1 + (Z_i - z_i) / R + O(1 / R^2),
// so (x, y)_i = (X, Y)_i l_i / L_i -> (X, Y)_i. The first two components of the difference are O(1 / R). The
// third component tends to (K z)_i - (K Z)_i. The limit is a thin plate on the old surface, bent by the
// smooth change of the depths:
//   minimise sum_i w_i^2 A_i ((K z)_i - (K Z)_i)^2   under 0 <= z_i <= h.
// K = A^-1 C, where C has the cotangents of the triangles in space.
//
// The weights w_i are 1, because all points are visible. The paper lets groups of vertices move freely
// against each other. Here the triangles of depth jumps are left out, and these groups are the connected
// parts that remain. A_i is a third of the area of the triangles around the vertex. The silhouette is fixed
// at z = 0, because a scan has no surface behind it. On both scans that were tried, less of the shading is
// reproduced if the silhouette is free above a wall.
Result<std::vector<double>> mimicking_heights(const Surface& surface, double height);

// An ablation of the layered method, without layers, height correction and forces for the order of depths. It
// compresses all slopes evenly by equation (5), with the same weight w_k at all points. Then it solves
// equation (9) under the bounds of the height. `weight` is w_k, in [0, 1].
Result<std::vector<double>> bounded_heights(const Surface& surface, double height, double weight);

}  // namespace relievo
