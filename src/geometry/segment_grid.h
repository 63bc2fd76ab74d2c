// Finds segments of plane curves that are near a point or crossed by a line.
#pragma once

#include <span>
#include <vector>

#include "core/groups.h"
#include "core/simd.h"
#include "relievo/core/types.h"

namespace relievo {

struct Segment {
  Vec2 from, to;
  Index curve = 0;  // the number of the segment's curve
};

// The result of SegmentGrid::nearest().
struct NearestSegment {
  Index segment = no_index;  // no_index if no segment is near enough
  double distance = 0;
  bool is_left = false;  // whether the query point is on the left of the curve
};

// Segments in the cells of a square grid.
class SegmentGrid {
 public:
  // `cell` > 0 is the width of a cell; the usual radius of queries is a good choice.
  SegmentGrid(std::vector<Segment> segments, double cell);

  std::span<const Segment> segments() const { return segments_; }

  // Returns the nearest segment within the radius, ignoring curve number `except`. If the nearest point is
  // shared by two segments of a curve, the segment whose line is farther from `place` determines `is_left`.
  NearestSegment nearest(const Vec2& place, double radius, Index except = no_index) const;

  // Returns the nearest segment within the radius whose direction differs from `direction`, a unit vector, by
  // at most 107 degrees.
  NearestSegment nearest_along(const Vec2& place, double radius, const Vec2& direction) const;

  // Returns whether a segment of the grid properly crosses the line from a to b: the ends of each of the two
  // are on different sides of the other one.
  bool is_crossed(const Vec2& a, const Vec2& b) const;

 private:
  friend class LinesFrom;
  struct Cells {
    int x0, y0, x1, y1;
  };
  Cells cells_of(const Vec2& low, const Vec2& high) const;
  // Returns the segments in the cells of row y. A segment that lies in several cells occurs several times.
  std::span<const Index> in_row(int y, const Cells& cells) const {
    if (cells.x0 > cells.x1) return {};
    const std::size_t row = static_cast<std::size_t>(y) * width_;
    const std::size_t begin = in_cell_.begin[row + cells.x0], end = in_cell_.begin[row + cells.x1 + 1];
    return std::span(in_cell_.items).subspan(begin, end - begin);
  }
  template <typename Accept>
  NearestSegment nearest_of(const Vec2& place, double radius, Accept&& accepts) const;

  std::vector<Segment> segments_;
  Vec2 origin_ = Vec2::Zero();
  double cell_ = 1;
  int width_ = 0, height_ = 0;
  Groups<Index, std::size_t> in_cell_;
};

// Does the same as SegmentGrid::is_crossed() for many short lines that start at one place; tests four segments at a
// time.
class LinesFrom {
 public:
  // Sets the start of the lines to `from`. Keeps the segments that lines of at most the length `radius` may cross.
  void begin(const SegmentGrid& grid, const Vec2& from, double radius);

  // Returns whether a segment crosses the line from the start to `to`.
  bool is_crossed(const Vec2& to) const;

 private:
  // Four segments. Unused entries are segments without length, which no line crosses.
  struct Four {
    Double4 from_x = {}, from_y = {};                        // first ends of the segments
    Double4 u_x = {}, u_y = {}, v_x = {}, v_y = {};          // both ends, relative to the start of the lines
    Double4 step_x = {}, step_y = {}, place_is_beside = {};  // last: > 0 if the start is left of the segment
  };
  RELIEVO_INLINE bool is_any_crossed(const Vec2& to) const;

  Vec2 from_ = Vec2::Zero();
  std::vector<Four> fours_;
};

}  // namespace relievo
