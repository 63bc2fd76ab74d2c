// Finds the points of a surface that belong to a stroke.
#pragma once

#include <vector>

#include "relievo/relief/stroke.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Points of an area, and the distance of each from where the change is full: in [0, the stroke's radius).
struct StrokePoints {
  std::vector<Index> points;
  std::vector<double> distances;
};

// Returns the points of a stroke, without those on the boundary; none if the view does not show the stroke.
//
// A line has the points that are nearer than the radius in space, and connected to points beside it without crossing a
// depth jump. Distances are those from the line.
//
// A lasso has the points that its closed line encloses, seen along its direction, whose normals face
// its viewer, and which are not deeper than its deepest corner by more than half of its size. So in other views it
// does not change what was hidden behind it.
//
// A region has the points that can be reached from the point nearest to its own without crossing a depth jump, and
// without points at which the surface turns by more than the tolerance. In lassos and regions, the distance is the
// radius minus the distance from the edge, at least 0.
StrokePoints points_of(const Surface& surface, const Stroke& stroke);

}  // namespace relievo
