// Control points (stage 7): a few thousand visible points that represent all visible points. Paper, section
// 4.2.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/relief/method.h"

namespace relievo {

struct ControlPointOptions {
  std::size_t count = usual_control_points;  // approximate number of control points, the paper's n2; > 0
  double at_boundary = .5;  // spacing at the boundary, as a share of the spacing inside, (0, 1]
};

struct ControlPoints {
  // Indices of the control points; those on the boundary come first.
  std::vector<Index> points;
  std::size_t boundary_points = 0;
  double radius = 0;  // the paper's r2: every point has a control point within it; 0 if all are chosen
};

// Chooses about `count` of the points in the view plane, by growing regions from the boundary inwards.
// `boundary_distance` is the distance of each point to the boundary, 0 on it.
//
// A point is chosen unless an earlier chosen point is nearer than the spacing. On the boundary the spacing is
// `at_boundary` times the result's `radius`. Inwards it grows by half the distance to the boundary, up to
// `radius`. All points are chosen if there are no more than `count`. The result does not depend on the order
// of the points, except for coincident ones.
ControlPoints grow_control_points(std::span<const Vec2> points, std::span<const float> boundary_distance,
                                  const ControlPointOptions& options = {});

}  // namespace relievo
