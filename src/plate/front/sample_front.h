// Samples the smooth surface of a front by well-shaped triangles. Tested by
// tests/plate/sample_front_test.cpp.
#pragma once

#include <span>

#include "relievo/core/progress.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct FrontSampling {
  // Longest step between samples, > 0, where the surface is not plane.
  double resolution_mm = .15;
  // Largest angle between neighbouring facets, in radians, where the surface turns evenly. Samples are up to
  // 8 steps apart where the surface turns less, and half a step apart where it turns more.
  double facet_angle = .034;
};

// Returns a front over the same hull. Its points lie on the smooth surface through the given front: on a grid
// of squares, and near creases on the triangles of the given front, divided equally finely. `is_smooth` marks
// the smooth triangles; the others stay plane, and creases are the edges between smooth triangles and others.
// The highest and the lowest point stay. Errors: kind cancelled.
Result<HeightFieldMesh> sample_front(const HeightFieldMesh& front, std::span<const std::uint8_t> is_smooth,
                                     const FrontSampling& options, const Progress* progress = nullptr);

}  // namespace relievo
