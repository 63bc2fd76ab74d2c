// A baseline that weights two layers of the normals. Source: Wei, Tian, Pang, Wang, Pang, Wang, Qin and Heng,
// Bas-relief modeling from normal layers, IEEE Transactions on Visualization and Computer Graphics 25(4),
// 2019. Tested by tests/relief/normal_layers_test.cpp.
//
// From their text: the model is split in the normal field into a base layer, which is smooth by pieces, and a
// detail layer. Reliefs that preserve detail flatten the base and keep the detail; those that preserve
// structure keep more of the base. As in the smoothing of meshes in two steps, normals are changed first, and
// then the heights are fitted to them by least squares.
//
// Only that much of their text was at hand. The rest is a reading of it: the base is the result of an
// iterated bilateral filter of normals along the triangulation; the detail is the least rotation from the
// base to the normal; weights are shares of angles; and the heights are those of equation (9).
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

struct NormalLayerWeights {
  double base = .25;  // share of the base's angle to the view that is kept; 0 flattens it
  double detail = 1;  // share of the angle between base and normal that is kept
};

// Returns the base layer. `scale` is the standard deviation of the smoothing on a smooth surface, as a share
// of the surface's longer side. Normals that differ by more than 40 degrees, and those across depth jumps, do
// not mix.
std::vector<Vec3f> base_normals(const Surface& surface, double scale);

// Returns the normal that keeps these shares of both layers.
Vec3f weighted_normal(const Vec3f& normal, const Vec3f& base, const NormalLayerWeights& weights);

}  // namespace relievo
