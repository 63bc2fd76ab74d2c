// Moves outlines that were found from samples of a mesh onto the mesh's exact outlines.
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

  // Marks as outside those triangles over gaps between samples whose middle lies beyond the silhouette.
  void open_gaps(Surface& surface) const;

  // Returns the exact curve of an outline that was found from samples. `places` lie near it, in the order of
  // the outline, with the surface on their left. Where no exact outline is near place i, the curve goes
  // through the node `guess(i)` instead.
  template <typename Guess>
  FairCurve curve(std::span<const Vec2> places, bool is_closed, bool is_jump, Guess&& guess) const {
    std::vector<CurveNode> nodes;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!add_nodes(places, i, is_closed, is_jump, nodes)) nodes.push_back(guess(i));
    return on_outline(nodes, is_closed, is_jump);
  }

 private:
  // Adds nodes on the exact outlines, nearest to places from the i-th to the next. Returns whether there is a
  // node for the i-th place itself.
  bool add_nodes(std::span<const Vec2> places, std::size_t i, bool is_closed, bool is_jump,
                 std::vector<CurveNode>& nodes) const;
  FairCurve on_outline(std::span<const CurveNode> nodes, bool is_closed, bool is_jump) const;
  // Returns the nearest place on an exact outline that leads in that direction. A sampled silhouette may lie
  // on an exact jump, if too little is seen of the surface behind it.
  std::optional<Vec2> nearest(const Vec2& place, double radius, const Vec2& direction, bool is_jump) const;

  double rho_;
  SegmentGrid silhouettes_, jumps_;
};

}  // namespace relievo
