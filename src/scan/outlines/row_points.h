// Makes rows of points beside outlines. Tested by tests/scan/outlines_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "geometry/point_set.h"
#include "geometry/segment_grid.h"
#include "scan/outlines/outlines.h"

namespace relievo {

// The kind of position of a point of the surface.
enum class Place : std::uint8_t {
  scan,        // a point of the scan
  silhouette,  // a point on the silhouette
  front,       // front, back: on the upper or the lower edge of the wall at a jump
  back,
  row,  // a point in another row beside an outline, or inside a gap
};

inline constexpr Index no_row = no_index;

// A new point before its depth and normal are known.
struct RowPoint {
  Vec2 at;
  Vec2 seen_from;  // values are interpolated from points that no outline separates from this position
  Place place;
  Index row = no_row;  // index of the row; a corner of the outline begins a new row
};

// Lengths in rho: half the width of the wall at a jump, and the distance of the last row from its outline.
inline constexpr double half_wall = .15, last_row = 2.95;

// The least n_z of normals at new points, so they are tilted by at most 88.9 degrees.
inline constexpr double least_nz = .02;

// Returns the unit normal whose (n_x, n_y) is `lean`. If n_z would be less than least_nz, `lean` is
// shortened.
inline Vec3 normal_with(Vec2 lean) {
  const double most = std::sqrt(1 - least_nz * least_nz);
  if (lean.norm() > most) lean *= most / lean.norm();
  return {lean.x(), lean.y(), std::sqrt(1 - lean.squaredNorm())};
}

// Returns the points of all rows, and adds them to `taken`, whose cells must be at least 0.7 rho wide. Points on the
// silhouette come first, then points on both sides of each jump, then parallel rows in the order of their distance
// from the outline. A point is left out if another outline is nearer to it than its own outline, or lies between the
// point and its own outline. It is also left out if a point of an earlier row is too close.
std::vector<RowPoint> row_points(const std::vector<OutlineCurve>& outlines, const SegmentGrid& grid,
                                 double rho, PointSet& taken);

// Values at the surface's points. They are not needed any more once the boundary is found.
struct PointMeasures {
  std::vector<double> k;       // mean curvature; 0 at hole-fill points
  std::vector<float> spacing;  // Spacing::local for clouds of uneven density, else empty
};

// Interpolates values at new points from points on the same side of all outlines. Keeps references to its arguments,
// which must outlive it.
class SideInterpolation {
 public:
  struct Input {
    const Surface& surface;
    const PlanePoints& plane;  // the surface's points in the view plane
    const PointMeasures& measures;
    const SegmentGrid& grid;
    std::span<const float> outline_distance;  // per point: distance from the nearest outline
  };
  explicit SideInterpolation(const Input& input) : in_(input) {}

  struct Value {
    bool is_known = false;
    Vec3 point;
    Vec3f normal;
    Colour colour = {};
    float own_height = 0;
    double k = 0;
    float spacing = 0;
  };

  // Returns the values at new points. A value is computed from the surrounding points that no outline separates from
  // the new point. A linear fit gives its normal and curvature. depth_at() of the nearest points gives its depth.
  std::vector<Value> at(std::span<const RowPoint> rows) const;

 private:
  using Match = KdTree<Vec2>::Match;

  // The points around a new point, and the lines from RowPoint::seen_from to these points.
  struct Around {
    std::vector<Match> matches;
    LinesFrom lines;
  };

  Value at(const RowPoint& p, Around& around) const;
  void leave_same_side(const RowPoint& p, double radius, Around& around) const;
  void leave_same_face(std::vector<Match>& matches) const;
  Value interpolated(const RowPoint& p, double radius, std::span<const Match> matches) const;
  double depth_at(const Vec2& at, const Vec3& normal, std::span<const Match> matches) const;

  Input in_;
};

// Returns the values at points of rows, smoothed along each row. Depth, normal and curvature come from a
// quadratic that is fitted to the points of the same row within 3 rho; outliers have little weight. Points
// without a row and points with unknown values do not change.
std::vector<SideInterpolation::Value> smoothed_along_rows(std::span<const RowPoint> points,
                                                          std::vector<SideInterpolation::Value> values,
                                                          double rho);

}  // namespace relievo
