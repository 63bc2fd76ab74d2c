// Finds the segments of curves in the plane that are near a place or crossed by a line.
// Tested by tests/geometry/segment_grid_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "core/groups.h"
#include "relievo/core/types.h"

namespace relievo {

struct Segment {
  Vec2 from, to;
  Index curve = 0;  // the number of the segment's curve
};

// The result of SegmentGrid::nearest().
struct NearestSegment {
  Index segment = no_index;  // no_index if none is near enough
  double distance = 0;
  bool is_left = false;  // the place lies on the left of the curve
};

// Segments in the cells of a square grid.
class SegmentGrid {
 public:
  // `cell` is the side of a cell, > 0, best about the usual radius of queries.
  SegmentGrid(std::vector<Segment> segments, double cell);

  std::span<const Segment> segments() const { return segments_; }

  // Returns the nearest segment within the radius, of all curves except number `except`. Beside a point where
  // two segments of a curve meet, the side is that of the segment whose line is farther away.
  NearestSegment nearest(const Vec2& place, double radius, Index except = no_index) const;

  // Returns the nearest segment within the radius whose direction is at most 107 degrees from the given one,
  // which has unit length.
  NearestSegment nearest_along(const Vec2& place, double radius, const Vec2& direction) const;

  // Returns true if a segment and the line from a to b cross: the two ends of each lie on different sides of
  // the other.
  bool is_crossed(const Vec2& a, const Vec2& b) const;

 private:
  struct Cells {
    int x0, y0, x1, y1;
  };
  Cells cells_of(const Vec2& low, const Vec2& high) const;
  template <typename Accept>
  NearestSegment nearest_of(const Vec2& place, double radius, Accept&& accepts) const;

  std::vector<Segment> segments_;
  Vec2 origin_ = Vec2::Zero();
  double cell_ = 1;
  int width_ = 0, height_ = 0;
  Groups<Index, std::size_t> in_cell_;
};

}  // namespace relievo
