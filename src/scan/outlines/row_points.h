// Rows of places beside outlines. Tested by tests/scan/outlines_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "geometry/point_set.h"
#include "geometry/segment_grid.h"
#include "scan/outlines/outlines.h"

namespace relievo {

// The kind of place where a point of the surface lies.
enum class Place : std::uint8_t {
  scan,        // a point of the scan
  silhouette,  // on the silhouette
  front,       // on the front or the back edge of the wall at a jump
  back,
  row,  // in a row farther from an outline, or in the middle of a gap
};

inline constexpr Index no_row = no_index;

// A new point before its depth and normal are known.
struct RowPoint {
  Vec2 at;
  Vec2 seen_from;  // a place on one side; the points on that side are interpolated
  Place place;
  Index row = no_row;  // the points of a row between two corners follow each other and have one number
};

// In rho: half the width of the wall at a jump, and the distance from the last row to its outline.
inline constexpr double half_wall = .15, last_row = 2.95;

inline constexpr double least_nz = .02;  // normals at new points lean at most 88.9 degrees

// Returns the points of all rows, and adds them to `taken`, whose cells must be at least 0.7 rho wide. Points
// on the silhouette come first, then those on both sides of each jump, then parallel rows in the order of
// their distance from the outline. Points of a row are left out if they would lie nearer to another outline,
// behind one, or too near to a point of an earlier row.
std::vector<RowPoint> row_points(const std::vector<OutlineCurve>& outlines, const SegmentGrid& grid,
                                 double rho, PointSet& taken);

// Values at the surface's points that only the stages up to the boundary need.
struct PointMeasures {
  std::vector<double> k;       // mean curvature, 0 at hole fill points
  std::vector<float> spacing;  // Spacing::local of clouds of uneven density, else empty
};

// Keeps views of its arguments, which must outlive it.
class SideInterpolation {
 public:
  struct Input {
    const Surface& surface;
    const PlanePoints& plane;  // the points of the surface
    const PointMeasures& measures;
    const SegmentGrid& grid;
    std::span<const float> outline_distance;  // distance of each point from the nearest outline
  };
  explicit SideInterpolation(const Input& input);

  struct Value {
    bool is_known = false;
    Vec3 point;
    Vec3f normal;
    Colour colour = {};
    float own_height = 0;
    double k = 0;
    float spacing = 0;
  };

  // Returns the values at new points, computed from the points around each that no outline separates from it.
  // Normal and curvature come from a linear fit to these points, the depth from the chords to the nearest of
  // them.
  std::vector<Value> at(std::span<const RowPoint> rows) const;

 private:
  using Match = KdTree<Vec2>::Match;

  // The points around a new point, and lines from the place that it is seen from.
  struct Around {
    std::vector<Match> matches;
    LinesFrom lines;
  };

  Value at(const RowPoint& p, Around& around) const;
  void leave_same_side(const RowPoint& p, double radius, Around& around) const;
  void leave_same_face(std::vector<Match>& matches) const;
  Value interpolated(const RowPoint& p, double radius, std::span<const Match> matches) const;
  double depth_at(const Vec2& at, const Vec3& normal, std::span<const Match> matches) const;

  const Surface& surface_;
  const PointMeasures& measures_;
  const SegmentGrid& grid_;
  std::span<const float> outline_distance_;
  float on_outline_;
  const std::vector<Vec2>& plane_;
  const KdTree<Vec2>& tree_;
};

}  // namespace relievo
