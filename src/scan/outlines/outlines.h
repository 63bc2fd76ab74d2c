// Finds the outlines of the visible surface as smooth curves: its silhouette, and the depth jumps inside it.
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
  // For positions from places[i] to the next place, adds the nearest nodes on exact outlines. Returns whether places[i]
  // itself has a node.
  bool add_nodes(std::span<const Vec2> places, std::size_t i, bool is_closed, bool is_jump,
                 std::vector<CurveNode>& nodes) const;
  FairCurve on_outline(std::span<const CurveNode> nodes, bool is_closed, bool is_jump) const;
  // Returns the nearest position on an exact outline with about this direction: on a jump if `is_jump`, else
  // on a silhouette. If no such silhouette is near, returns a position on a jump, because the samples show a
  // silhouette where little of the surface behind a jump is visible.
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

// Returns the options for curves of jumps: smoothness and distance between points. The points of creases are about as
// far apart as those of scans, because only steps need closer points.
FairCurveOptions jump_curve_options(double rho, bool is_crease = false);

// The distance between the points of a crease, in rho.
inline constexpr double crease_spacing = 1.25;

// The points of a surface in the view plane.
struct PlanePoints {
  std::vector<Vec2> places;
  KdTree<Vec2> tree;

  explicit PlanePoints(const Surface& surface) : places(in_plane(surface.points)), tree(places) {}
};

// Returns whether two neighbouring points lie on different surfaces: their depths differ by more than 3 rho plus
// twice the difference that the mean of their normals explains. (The chord of a circle is perpendicular to the mean
// of the normals at its ends.) Unlike this function, is_jump() uses the steeper of the two normals. Where a surface
// turns away from the viewer, that normal explains so large a difference that is_jump() misses jumps.
bool is_occlusion(const Surface& surface, Index a, Index b);

// Marks small connected parts of the surface (crumbs) as outside, and holes of less than 4 rho^2 as inside. Adds the
// number of removed parts to surface.crumbs. Crumbs have less than 0.5 % of the surface's area. If View::has_crumbs is
// set, only parts of less than 20 rho^2 are removed, which are too small for an outline. If View::most_pieces is set,
// at most so many parts are kept, the largest ones. Returns whether any triangle is still inside.
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

// Adds inner lines to the outlines of a surface, as jumps with the higher side on the left. Jumps that end inside the
// surface are continued as long as the surface bends or steps. Lines keep a distance of 2 rho from other outlines.
// New lines shorter than 8 rho are left out.
void add_inner_lines(const Surface& surface, const PlanePoints& plane, std::vector<OutlineCurve>& outlines);

// Joins two open jumps if one ends at most 4 rho before the other begins and both have the direction of the gap. Such
// gaps occur where the step in depth is close to the least step of a jump. Silhouettes and closed jumps stay as they
// are.
void join_jumps(std::vector<OutlineCurve>& outlines, double rho);

}  // namespace relievo
