// Finds the points of a surface that belong to a stroke.
#pragma once

#include <vector>

#include "relievo/relief/stroke.h"
#include "relievo/scan/surface.h"

namespace relievo {

// The points of an area. Each has a distance from the part of the area that is changed fully; the distance is
// in [0, the stroke's radius).
struct StrokePoints {
  std::vector<Index> points;
  std::vector<double> distances;
};

// Returns the points of a stroke, without those on the boundary; none if the view does not show the stroke.
//
// A line consists of points whose distance from it, in space, is less than the radius. They must connect to
// points beside the line without crossing a depth jump. The distances in the result are those from the line.
//
// A lasso consists of the points that its closed line encloses when seen along the lasso's direction. Their normals
// face the viewer who drew it, and they lie at most half of the lasso's size behind its deepest corner. So a lasso
// never changes parts that were hidden behind it when it was drawn, even if another view shows them.
//
// A region consists of the points that can be reached along edges from the point nearest to its own point. Edges across
// depth jumps, and points at which the surface turns by more than the tolerance, are not passed. In lassos and regions,
// the distance is the radius minus the distance from the edge, at least 0.
StrokePoints points_of(const Surface& surface, const Stroke& stroke);

}  // namespace relievo
