// Control points (stage 7): a few thousand of the visible points that stand for all. Paper, section 4.2.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

struct ControlPointOptions {
  std::size_t count = 8000;  // about as many, n2 of the paper; > 0
  double at_boundary =
      .5;  // radius at the boundary, as a share of the radius inside, (0, 1]: the rim is denser
};

struct ControlPoints {
  // Indices of the control points; those on the boundary come first.
  std::vector<Index> points;
  std::size_t boundary_points = 0;
  double radius = 0;  // r2: every point lies within it of a control point; 0 if all points are control points
};

// Returns control points of the points in the view plane, about as many as wanted, by growing regions from
// the boundary inwards.
//
// `boundary_distance` holds per point the distance to the boundary, 0 on it. No two boundary points chosen
// are nearer than `at_boundary` radii; towards the inside the spacing widens by half the distance to the
// boundary until it is one radius, and no point inside is nearer to one chosen before than that. All points
// are chosen if that many are wanted. The result does not depend on the order of the points, except for
// coincident ones.
ControlPoints grow_control_points(std::span<const Vec2> points, std::span<const float> boundary_distance,
                                  const ControlPointOptions& options = {});

}  // namespace relievo
