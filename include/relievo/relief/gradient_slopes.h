// The slopes of gradient-domain compression: the baseline that the height correction is tuned against. After
// Weyrich, Deng, Barnes, Rusinkiewicz and Finkelstein, Digital bas-relief from 3D scenes, 2007.
#pragma once

#include <vector>

#include "relievo/core/types.h"

namespace relievo {

struct Surface;

struct GradientOptions {
  double attenuation = 5;     // a, > 0
  double steepest_kept = 10;  // gradients steeper than this are removed
  // Weights of the bands, from the finest on. A band is the difference between blurs by two Gaussians, each
  // twice as wide as the one before; the last band is the rest.
  std::vector<double> band_weights{1, 1, .8, .6};
  double finest_band = .01;  // the first Gaussian's standard deviation, as a share of the longer side
};

// Returns a slope per point: gradients at silhouettes are removed, the others attenuated by log(1 + a |g|) /
// a and their frequency bands weighted. The gradients come from the scan's normals instead of differences of
// a height map: they are free of its noise, and no gradient needs to be removed across a depth jump.
std::vector<Vec2> gradient_slopes(const Surface& surface, const GradientOptions& options = {});

// Returns the surface's slope (dz/dx, dz/dy) at a normal with z > 0, at most 1e3.
Vec2 slope_of(const Vec3f& normal);

// Returns log(1 + a |g|) / a along the gradient's direction.
Vec2 attenuated(const Vec2& gradient, double a);

}  // namespace relievo
