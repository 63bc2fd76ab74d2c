// Puts outlines that were found by samples of a mesh onto the mesh's exact outlines.
// Tested by tests/scan/mesh_outlines_test.cpp.
#pragma once

#include <optional>

#include "geometry/fair_curve.h"
#include "geometry/segment_grid.h"
#include "relievo/scan/surface.h"

namespace relievo {

class ExactOutlines {
 public:
  // `segments` are in view coordinates.
  ExactOutlines(std::span<const OutlineSegment> segments, double rho);

  bool empty() const { return silhouettes_.segments().empty() && jumps_.segments().empty(); }

  // Returns whether a line in the view plane crosses a depth jump.
  bool is_across_jump(const Vec2& a, const Vec2& b) const { return jumps_.is_crossed(a, b); }

  // Marks as outside the triangles over gaps between samples that have their middle beyond the silhouette.
  void open_gaps(Surface& surface) const;

  // Returns the curve along an outline that was found: `places` are near it, in its order, with the surface on their
  // left. Where no exact outline is near, the curve goes through `guess(i)`, which is asked for place i then.
  template <typename Guess>
  FairCurve curve(std::span<const Vec2> places, bool is_closed, bool is_jump, Guess&& guess) const {
    std::vector<CurveNode> nodes;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!add_nodes(places, i, is_closed, is_jump, nodes)) nodes.push_back(guess(i));
    return on_outline(nodes, is_closed, is_jump);
  }

 private:
  // Adds the nearest places of exact outlines for places between the i-th and the next. Returns whether there is one
  // for the i-th.
  bool add_nodes(std::span<const Vec2> places, std::size_t i, bool is_closed, bool is_jump,
                 std::vector<CurveNode>& nodes) const;
  FairCurve on_outline(std::span<const CurveNode> nodes, bool is_closed, bool is_jump) const;
  // Returns the nearest place of an exact outline that leads in that direction. A silhouette may lie on a jump: what is
  // seen behind it may be too little for a surface.
  std::optional<Vec2> nearest(const Vec2& place, double radius, const Vec2& direction, bool is_jump) const;

  double rho_;
  SegmentGrid silhouettes_, jumps_;
};

}  // namespace relievo
