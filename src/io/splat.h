// Finds the normals of Gaussian splats from their scales and rotations, for all formats.
#pragma once

#include <array>
#include <limits>

#include "relievo/core/types.h"

namespace relievo::io {

// The logarithm of the third scale of splats that are flat discs. This scale is 0; files state only the other
// two scales.
constexpr double no_depth = -std::numeric_limits<double>::infinity();

// Returns the unit vector along which a splat is thinnest. Its sign is arbitrary. `log_scales` are the
// logarithms of its scales, `rotation` is a quaternion w, x, y, z of any length. The result is zero if the
// two smallest scales are nearly equal, which makes the direction arbitrary, or if the rotation is zero or
// not finite.
Vec3f splat_axis(const Vec3& log_scales, const std::array<double, 4>& rotation);

}  // namespace relievo::io
