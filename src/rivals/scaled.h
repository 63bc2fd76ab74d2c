// What all rivals end with.
#pragma once

#include <span>

#include "relievo/relief.h"

namespace relievo {

// Puts the boundary points on the base and scales to the height.
Relief scaled_relief(std::vector<double> heights, const Surface& surface, double height);

// Every point's depth above the deepest.
std::vector<double> depths(const Surface& surface);

// The longer side of the points' box in the view plane.
double longer_side(const Surface& surface);

// The surface's slope (dz/dx, dz/dy) at a normal with z > 0, at most 1e3.
Vec2 slope_of(const Vec3f& normal);

}  // namespace relievo
