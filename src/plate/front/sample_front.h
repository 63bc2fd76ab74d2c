// Samples the smooth surface of a front with well-shaped triangles.
#pragma once

#include <span>

#include "relievo/core/progress.h"
#include "relievo/plate/solid.h"

namespace relievo {

struct FrontSampling {
  // Largest distance between samples, > 0, except where the surface is nearly plane.
  double resolution_mm = .15;
  // Largest angle between neighbouring facets, in radians, where the curvature is even. Where the surface is
  // flatter, samples are up to 8 steps of `resolution_mm` apart. Where it is more curved, they are half a
  // step apart.
  double facet_angle = .034;
};

// Returns a front with the same hull. Its points lie on the smooth surface through the given front, most of
// them on a square grid. `is_smooth` marks the smooth triangles; the other triangles stay plane. Creases are
// the edges between smooth triangles and others. Near creases the given front's triangles are kept, and
// divided until their edges are about as long as the grid step. The highest and the lowest point are kept.
// Errors: kind cancelled.
Result<HeightFieldMesh> sample_front(const HeightFieldMesh& front, std::span<const std::uint8_t> is_smooth,
                                     const FrontSampling& options, const Progress* progress = nullptr);

}  // namespace relievo
