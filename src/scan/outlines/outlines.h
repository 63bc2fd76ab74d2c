// Outlines of the visible surface as smooth curves: its silhouette, and the depth jumps inside.
// Tested by tests/scan/outlines_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "geometry/fair_curve.h"
#include "geometry/neighbours.h"
#include "geometry/segment_grid.h"
#include "relievo/scan/surface.h"

namespace relievo {
// Moves outlines that were found from samples of a mesh onto the mesh's exact outlines.
class ExactOutlines {
 public:
  // `segments` are in view coordinates.
  ExactOutlines(std::span<const OutlineSegment> segments, double rho);

  bool empty() const { return silhouettes_.segments().empty() && jumps_.segments().empty(); }

  // Returns whether a line in the view plane crosses a depth jump.
  bool is_across_jump(const Vec2& a, const Vec2& b) const { return jumps_.is_crossed(a, b); }

  // Marks triangles over gaps between samples as outside if their middle lies beyond the silhouette.
  void open_gaps(Surface& surface) const;

  // Returns the exact curve of an outline that was found from samples. `places` lie near the outline, in its
  // order, with the surface on their left. Where no exact outline is near place i, the curve goes through the
  // node `guess(i)` instead.
  template <typename Guess>
  FairCurve curve(std::span<const Vec2> places, bool is_closed, bool is_jump, Guess&& guess) const {
    std::vector<CurveNode> nodes;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!add_nodes(places, i, is_closed, is_jump, nodes)) nodes.push_back(guess(i));
    return on_outline(nodes, is_closed, is_jump);
  }

 private:
  // Adds the nodes on exact outlines that are nearest to places from the i-th to the next. Returns whether
  // there is a node for the i-th place itself.
  bool add_nodes(std::span<const Vec2> places, std::size_t i, bool is_closed, bool is_jump,
                 std::vector<CurveNode>& nodes) const;
  FairCurve on_outline(std::span<const CurveNode> nodes, bool is_closed, bool is_jump) const;
  // Returns the nearest place on an exact outline that leads in that direction. What samples show as a
  // silhouette may be an exact jump, if too little is seen of the surface behind the jump.
  std::optional<Vec2> nearest(const Vec2& place, double radius, const Vec2& direction, bool is_jump) const;

  double rho_;
  SegmentGrid silhouettes_, jumps_;
};

// A curve in the view plane. It is the edge of the surface on its left. On its right lies the ground or, at a
// jump, the surface behind.
struct OutlineCurve {
  FairCurve curve;
  bool is_closed = false;
  bool is_jump = false;
};

// Returns how smooth the curves of jumps are.
FairCurveOptions jump_curve_options(double rho);

// The points of a surface in the view plane.
struct PlanePoints {
  std::vector<Vec2> places;
  KdTree<Vec2> tree;

  explicit PlanePoints(const Surface& surface) : places(in_plane(surface.points)), tree(places) {}
};

// Returns whether two neighbouring points lie on surfaces that are not connected: whether their depths differ
// by more than 3 rho plus twice the difference that the mean of their normals explains. (The chord of a
// circle is perpendicular to the mean of the normals at its ends.) is_jump() takes the steeper of the two
// normals instead. Where a surface turns away from the viewer, that normal allows so large a difference that
// jumps would be missed.
bool is_occlusion(const Surface& surface, Index a, Index b);

// Leaves out pieces of less than 0.5 % of the surface, which are crumbs of the scan, and closes holes of less
// than 4 rho^2: changes boundary.is_inside and adds to `crumbs`. If the view has crumbs, only pieces of less
// than 20 rho^2 are left out, because they are too small for an outline. If it shows a number of pieces, all
// but the largest are left out, too. Returns whether the surface has any triangle left.
bool drop_crumbs(Surface& surface);

// Returns first the silhouettes, which are closed, then the depth jumps. The surface's triangulation must
// have neighbours. Where a surface turns away from the viewer, the curve goes where the normals, continued,
// are perpendicular to the direction of view. Elsewhere it goes through the outermost points, or at jumps
// between the points in front and those behind. Where exact outlines are near, it goes along them instead.
// Silhouettes shorter than 3 rho and jumps shorter than 6 rho are left out.
std::vector<OutlineCurve> find_outlines(const Surface& surface, const PlanePoints& plane,
                                        const ExactOutlines& exact);

// Returns the segments of outlines. Each has the index of its outline as its curve.
std::vector<Segment> segments_of(const std::vector<OutlineCurve>& outlines);

}  // namespace relievo
