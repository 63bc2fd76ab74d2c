// Outlines of the visible surface as smooth curves: its silhouette, and the depth jumps inside.
// Tested by tests/scan/outlines_test.cpp.
#pragma once

#include <vector>

#include "geometry/fair_curve.h"
#include "geometry/neighbours.h"
#include "geometry/segment_grid.h"
#include "relievo/scan/surface.h"
#include "scan/outlines/exact_outlines.h"

namespace relievo {

// A curve in the view plane, the edge of the surface on its left. On its right lies the ground or, at a jump,
// the surface behind.
struct OutlineCurve {
  FairCurve curve;
  bool is_closed = false;
  bool is_jump = false;
};

// The points of a surface in the view plane.
struct PlanePoints {
  std::vector<Vec2> places;
  KdTree<Vec2> tree;

  explicit PlanePoints(const Surface& surface) : places(in_plane(surface.points)), tree(places) {}
};

// Returns whether no surface connects two neighbouring points of a surface, given their normals. The test
// uses that the chord of a circle is perpendicular to the mean of the normals at its ends. is_jump() would
// not do: at the edge of a surface that turns away from the viewer, the normal there explains any depth.
bool is_occlusion(const Surface& surface, Index a, Index b);

// Leaves out pieces of less than 0.5 % of the surface, as crumbs of the scan, and closes holes of less than 4
// rho^2: changes boundary.is_inside and adds to `crumbs`. If the view has crumbs, only pieces of less than 20
// rho^2, which are too small for an outline, are left out. Returns whether the surface has any triangle left.
bool drop_crumbs(Surface& surface);

// Returns first the silhouettes, which are closed, then the depth jumps. The surface's triangulation must
// have neighbours. Where a surface turns away from the viewer, the curve is where its normals, continued, are
// perpendicular to the view. Elsewhere it goes through the outermost points, or at jumps between the points
// in front and those behind. Where exact outlines are near, it goes along them instead. Silhouettes shorter
// than 3 rho and jumps shorter than 6 rho are left out.
std::vector<OutlineCurve> find_outlines(const Surface& surface, const PlanePoints& plane,
                                        const ExactOutlines& exact);

// Returns the segments of outlines; curve numbers are those of the outlines.
std::vector<Segment> segments_of(const std::vector<OutlineCurve>& outlines);

}  // namespace relievo
