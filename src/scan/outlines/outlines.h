// Outlines of the visible surface as smooth curves: its silhouette, and the depth jumps inside it.
#pragma once

#include <optional>
#include <vector>

#include "geometry/fair_curve.h"
#include "geometry/neighbours.h"
#include "geometry/segment_grid.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Replaces outlines found from samples of a mesh by the mesh's exact outlines.
class ExactOutlines {
 public:
  // `segments` are in view coordinates.
  ExactOutlines(std::span<const OutlineSegment> segments, double rho);

  bool empty() const { return silhouettes_.segments().empty() && jumps_.segments().empty(); }

  // Returns whether a segment in the view plane crosses a depth jump.
  bool is_across_jump(const Vec2& a, const Vec2& b) const { return jumps_.is_crossed(a, b); }

  // Marks triangles across gaps between samples as outside if their centre lies outside the silhouette.
  void open_gaps(Surface& surface) const;

  // Returns the exact curve of an outline found from samples. `places` are positions near the outline, in
  // order, with the surface on the left. Where no exact outline is near places[i], the curve goes through the
  // node `guess(i)` instead.
  template <typename Guess>
  FairCurve curve(std::span<const Vec2> places, bool is_closed, bool is_jump, Guess&& guess) const {
    std::vector<CurveNode> nodes;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!add_nodes(places, i, is_closed, is_jump, nodes)) nodes.push_back(guess(i));
    return on_outline(nodes, is_closed, is_jump);
  }

 private:
  // Adds the nodes on exact outlines nearest to the positions from places[i] to the next one. Returns whether
  // places[i] itself has a node.
  bool add_nodes(std::span<const Vec2> places, std::size_t i, bool is_closed, bool is_jump,
                 std::vector<CurveNode>& nodes) const;
  FairCurve on_outline(std::span<const CurveNode> nodes, bool is_closed, bool is_jump) const;
  // Returns the nearest position on an exact outline with about this direction. A silhouette in the samples
  // may be an exact jump, if too little of the surface behind the jump is visible.
  std::optional<Vec2> nearest(const Vec2& place, double radius, const Vec2& direction, bool is_jump) const;

  double rho_;
  SegmentGrid silhouettes_, jumps_;
};

// A curve in the view plane: the edge of the surface on its left. On its right is the ground or, at a jump,
// the surface behind.
struct OutlineCurve {
  FairCurve curve;
  bool is_closed = false;
  bool is_jump = false;
  bool is_crease = false;  // a jump without a step: the surface only bends there
};

// Returns how smooth the curves of jumps are, and how far apart their points. Points of creases are as far
// apart as those of scans, because only steps need closer ones.
FairCurveOptions jump_curve_options(double rho, bool is_crease = false);

// The distance between the points of a crease, in rho.
inline constexpr double crease_spacing = 1.25;

// The points of a surface in the view plane.
struct PlanePoints {
  std::vector<Vec2> places;
  KdTree<Vec2> tree;

  explicit PlanePoints(const Surface& surface) : places(in_plane(surface.points)), tree(places) {}
};

// Returns whether two neighbouring points lie on different surfaces: their depths differ by more than 3 rho
// plus twice the difference that the mean of their normals explains. (The chord of a circle is perpendicular
// to the mean of the normals at its ends.) is_jump() instead uses the steeper of the two normals. Where a
// surface turns away from the viewer, that normal explains so large a difference that jumps would be missed.
bool is_occlusion(const Surface& surface, Index a, Index b);

// Removes connected parts of less than 0.5 % of the surface (crumbs of the scan), and closes holes of less
// than 4 rho^2: changes boundary.is_inside and adds to `crumbs`. If the view has crumbs, only parts of less
// than 20 rho^2 are removed, because they are too small for an outline. If the view limits the number of
// parts, only the largest are kept. Returns whether any triangle is still inside.
bool drop_crumbs(Surface& surface);

// Returns the silhouettes, which are closed, then the depth jumps. The surface's triangulation must have
// neighbours. Where a surface turns away from the viewer, the curve lies where the extrapolated normals are
// perpendicular to the direction of view. Elsewhere it passes through the outermost points or, at jumps,
// between the points in front and the points behind. Exact outlines near a curve replace it. Silhouettes
// shorter than 3 rho and jumps shorter than 6 rho are left out.
std::vector<OutlineCurve> find_outlines(const Surface& surface, const PlanePoints& plane,
                                        const ExactOutlines& exact);

// Returns the segments of outlines. Segment::curve is the index of the outline.
std::vector<Segment> segments_of(const std::vector<OutlineCurve>& outlines);

// Adds inner lines to the outlines of a surface, as jumps with the higher side on the left. Jumps that end
// inside the surface are continued as long as the surface bends or steps. Lines keep a distance of 0.8 rho
// from other outlines. New lines shorter than 8 rho are left out.
void add_inner_lines(const Surface& surface, const PlanePoints& plane, std::vector<OutlineCurve>& outlines);

// Joins open jumps where one ends up to 4 rho before another one begins and both lead across the gap. Where the
// depth differs by little more than a jump needs, a jump is found in pieces. Without joining, the surface would be
// torn between the ends of two pieces. Silhouettes and closed jumps stay as they are.
void join_jumps(std::vector<OutlineCurve>& outlines, double rho);

}  // namespace relievo
