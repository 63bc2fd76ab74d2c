// What gradient-domain compression makes of a surface's slopes: a rival, and the yardstick for how tightly
// our own reliefs are held. After Weyrich, Deng, Barnes, Rusinkiewicz and Finkelstein, Digital bas-relief
// from 3D scenes, 2007.
#pragma once

#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

struct GradientOptions {
  double attenuation = 5;  // a, > 0
  double silhouette = 10;  // gradients steeper than this are removed
  // Weights of the bands, from the finest: each holds what a Gaussian of twice the last one's width takes
  // away; the last holds the rest.
  std::vector<double> band_weights{1, 1, .8, .6};
  double finest_band = .01;  // the first Gaussian's standard deviation, of the surface's longer side
};

// Returns a slope per point: gradients of silhouettes removed, attenuated by log(1 + a |g|) / a, their
// frequency bands weighted. The gradients come from the scan's normals, not from differences of a height map:
// free of its noise, and with nothing to remove across a depth jump.
std::vector<Vec2> gradient_slopes(const Surface& surface, const GradientOptions& options = {});

// The surface's slope (dz/dx, dz/dy) at a normal with z > 0, at most 1e3.
Vec2 slope_of(const Vec3f& normal);

// sign(g) log(1 + a |g|) / a along the gradient's direction.
Vec2 attenuated(const Vec2& gradient, double a);

}  // namespace relievo
