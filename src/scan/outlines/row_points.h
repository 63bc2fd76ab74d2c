// Rows of places beside outlines. Tested by tests/scan/outlines_test.cpp.
#pragma once

#include <vector>

#include "geometry/point_set.h"
#include "geometry/segment_grid.h"
#include "scan/outlines/outlines.h"

namespace relievo {

// The kind of place where a point of the surface lies.
enum class Place : std::uint8_t {
  scan,        // it is a point of the scan
  silhouette,  // the silhouette
  front,       // the edge of the wall at a jump, in front or behind
  back,
  row,  // a row farther from an outline, or the middle of a gap
};

// A new point before its depth and normal are known.
struct RowPoint {
  Vec2 at;
  Vec2 seen_from;  // a place on the side from whose points it is interpolated
  Place place;
};

// In rho: half the width of the wall at a jump, and the distance from the last row to its outline.
inline constexpr double half_wall = .15, last_row = 2.95;

// Returns the points of all rows, and adds them to `taken`, whose cells must be at least 0.7 rho wide. Those
// on the silhouette come first, then those on both sides of each jump, then parallel rows in the order of
// their distance. Points of a row that would lie nearer to another outline, behind one, or too near to a
// point of an earlier row are left out.
std::vector<RowPoint> row_points(const std::vector<OutlineCurve>& outlines, const SegmentGrid& grid,
                                 double rho, PointSet& taken);

}  // namespace relievo
