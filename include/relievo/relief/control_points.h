// Control points are a few thousand visible points that represent all visible points. They follow section 4.2
// of the paper, but are denser at the boundary. src/paper/control_points.h has the paper's own points.
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
  // Indices of the control points; boundary points come first.
  std::vector<Index> points;
  std::size_t boundary_points = 0;
  // The paper's r2: every point has a control point within this distance; 0 if all points are chosen.
  double radius = 0;
};

// Returns about `count` of the points in the view plane, chosen by region growing from the boundary inwards.
// `boundary_distance` is the distance of each point from the boundary; 0 on the boundary.
//
// A point is chosen unless a point chosen before is nearer than the spacing. On the boundary the spacing is
// `at_boundary` times the result's `radius`; inwards it grows by half the distance from the boundary, up to
// `radius`. If there are no more than `count` points, all are chosen. The result does not depend on the order
// of the points, except for coincident points.
ControlPoints grow_control_points(std::span<const Vec2> points, std::span<const float> boundary_distance,
                                  const ControlPointOptions& options = {});

}  // namespace relievo
