// Finds the points of a surface that belong to a stroke.
#pragma once

#include <vector>

#include "relievo/relief/stroke.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Points of an area. Each has a distance from the part of the area that is changed fully, in [0, the stroke's
// radius).
struct StrokePoints {
  std::vector<Index> points;
  std::vector<double> distances;
};

// Returns the points of a stroke, without those on the boundary; none if the view does not show the stroke.
//
// A line has the points that are nearer to it than the radius in space, and that connect to points beside the line
// without crossing a depth jump. Distances are those from the line.
//
// A lasso has the points that its closed line encloses when seen along its direction. Their normals face its viewer,
// and they lie at most half of the lasso's size behind its deepest corner. So a lasso does not change parts that were
// hidden behind it, also in other views.
//
// A region has the points that can be reached from the point nearest to its own point. Ways across depth jumps, or
// across points at which the surface turns by more than the tolerance, do not count. In lassos and regions, the
// distance is the radius minus the distance from the edge, at least 0.
StrokePoints points_of(const Surface& surface, const Stroke& stroke);

}  // namespace relievo
