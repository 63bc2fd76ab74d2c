// Computes the normals of a baseline that weights two layers of normals. Source: Wei, Tian, Pang, Wang, Pang, Wang, Qin and Heng,
// Bas-relief modeling from normal layers, IEEE Transactions on Visualization and Computer Graphics 25(4),
// 2019.
//
// The paper splits the field of normals into a piecewise smooth base layer and a detail layer. Reliefs that
// preserve detail flatten the base layer and keep the detail layer; reliefs that preserve structure keep more
// of the base layer. First the normals are changed, then heights are fitted to them by least squares.
//
// We had only the paper's summary, so the following is our interpretation. The base is the result of an
// iterated bilateral filter of normals along the triangulation. The detail is the shortest rotation from the
// base to the normal. Weights are fractions of angles. The heights solve equation (9) of Nie et al., as for all
// methods.
#pragma once

#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

struct NormalLayerWeights {
  // Share of the angle between view direction and base normal that is kept; 0 makes the base flat.
  double base = .25;
  double detail = 1;  // share of the angle between base normal and surface normal that is kept
};

// Returns the normals of the base layer. `scale` is the standard deviation of the smoothing on a smooth
// surface, as a share of the surface's longer side. Normals are not averaged if they differ by more than 40
// degrees, or if they are on two sides of a depth jump.
std::vector<Vec3f> base_normals(const Surface& surface, double scale);

// Returns the normal that keeps the given shares of the base and detail angles.
Vec3f weighted_normal(const Vec3f& normal, const Vec3f& base, const NormalLayerWeights& weights);

}  // namespace relievo
