// Defines solids as scalar fields, and scatters points over their surfaces.
#pragma once

#include <cstddef>
#include <cstdint>

#include "relievo/core/types.h"
#include "relievo/scan/cloud.h"

namespace relievo::field {

// A solid given by a distance bound. `value` is negative inside, positive outside and zero on the surface;
// its magnitude never exceeds the distance to the surface. `box` contains the whole surface.
struct Solid {
  double (*value)(const Vec3&) = nullptr;
  Box box;
};

struct Scatter {
  std::size_t points = 0;
  double noise = 0;  // standard deviation along the normal, in sampling distances
  std::uint64_t seed = 0;
};

// Returns exactly `how.points` points, uniformly distributed over the surface's area and then moved along
// their outward normals by Gaussian noise. The normals have the errors of normals estimated from such points.
// The same arguments give the same bits. The solid must have a surface.
Cloud scatter(const Solid& solid, const Scatter& how);

}  // namespace relievo::field
