// Control points (stage 7): a few thousand of the visible points, which represent all of them. Paper, section
// 4.2.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

struct ControlPointOptions {
  std::size_t count = 8000;  // approximate number of control points, the paper's n2; > 0
  double at_boundary =
      .5;  // radius at the boundary, as a share of the radius inside, (0, 1]: the rim is denser
};

struct ControlPoints {
  // Indices of the control points; those on the boundary come first.
  std::vector<Index> points;
  std::size_t boundary_points = 0;
  double radius = 0;  // r2: every point has a control point this near; 0 if all are chosen
};

// Returns control points of the points in the view plane, about as many as wanted, by growing regions from
// the boundary inwards.
//
// `boundary_distance` is the distance of each point to the boundary, 0 on it. No two chosen boundary points
// are nearer to each other than `at_boundary` radii. Towards the inside this spacing widens by half the
// distance to the boundary until it is one radius, and no chosen inner point is nearer to an earlier one than
// the spacing. All points are chosen if that many are wanted. The result does not depend on the order of the
// points, except for coincident ones.
ControlPoints grow_control_points(std::span<const Vec2> points, std::span<const float> boundary_distance,
                                  const ControlPointOptions& options = {});

}  // namespace relievo
