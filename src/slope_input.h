// What of a surface its slopes depend on.
#pragma once

#include "relievo/scan/surface.h"
#include "relievo/weights.h"

namespace relievo {

// Views the surface and the weights, which must outlive it.
inline SlopeInput slope_input(const Surface& surface, std::span<const float> boundary_weight) {
  return {surface.normals, surface.curvature.k, boundary_weight, surface.curvature.delta, surface.layers};
}

// What stands for rho in equation (7), which has 2 rho, for a boundary that is `width` rho wide.
inline double boundary_rho(const Surface& surface, double width) {
  return surface.rho * width / 2;
}

}  // namespace relievo
