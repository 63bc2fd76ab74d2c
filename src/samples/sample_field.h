// Solids as scalar fields, and clouds scattered over their surfaces. Private to the samples.
#pragma once

#include <cstddef>
#include <cstdint>

#include "relievo/core/types.h"
#include "relievo/scan/cloud.h"

namespace relievo::field {

// A solid: `value` is negative inside, positive outside, zero on the surface, and its magnitude is never
// above the distance to the surface. `box` holds the whole surface.
struct Solid {
  double (*value)(const Vec3&) = nullptr;
  Box box;
};

struct Scatter {
  std::size_t points = 0;
  double noise = 0;  // standard deviation along the normal, in sampling distances
  std::uint64_t seed = 0;
};

// Returns exactly `points` points, uniform by area over the surface, then moved along their outward normals
// by Gaussian noise; the normals waver with the noise as estimated ones do. Same arguments, same bits. The
// solid must have a surface.
Cloud scatter(const Solid& solid, const Scatter& how);

// Unit vector of steepest ascent of the field, by forward differences; exact to the curvature times 1e-6.
Vec3 outward_normal(const Solid& solid, const Vec3& p);

}  // namespace relievo::field
