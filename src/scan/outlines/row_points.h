// Rows of points beside outlines. Tested by tests/scan/outlines_test.cpp.
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
  row,  // a point in a row farther from an outline, or inside a gap
};

inline constexpr Index no_row = no_index;

// A new point before its depth and normal are known.
struct RowPoint {
  Vec2 at;
  Vec2 seen_from;  // a position on the same side; values are interpolated from points on that side
  Place place;
  Index row = no_row;  // index of the row; consecutive points of a row between two corners have the same one
};

// In rho: half the width of the wall at a jump; the distance of the last row from its outline.
inline constexpr double half_wall = .15, last_row = 2.95;

// n_z of normals at new points is at least this, which is 88.9 degrees.
inline constexpr double least_nz = .02;

// Returns the unit normal with this (n_x, n_y), shortened if n_z would be less than least_nz.
inline Vec3 normal_with(Vec2 lean) {
  const double most = std::sqrt(1 - least_nz * least_nz);
  if (lean.norm() > most) lean *= most / lean.norm();
  return {lean.x(), lean.y(), std::sqrt(1 - lean.squaredNorm())};
}

// Returns the points of all rows, and adds them to `taken`, whose cells must be at least 0.7 rho wide. Points
// on the silhouette come first, then points on both sides of each jump, then parallel rows in the order of
// their distance from the outline. A point is left out if it would be nearer to another outline, behind one,
// or too close to a point of an earlier row.
std::vector<RowPoint> row_points(const std::vector<OutlineCurve>& outlines, const SegmentGrid& grid,
                                 double rho, PointSet& taken);

// Values at the surface's points that only the stages up to the boundary use.
struct PointMeasures {
  std::vector<double> k;       // mean curvature; 0 at hole-fill points
  std::vector<float> spacing;  // Spacing::local for clouds of uneven density, else empty
};

// Keeps views of its arguments, which must outlive it.
class SideInterpolation {
 public:
  struct Input {
    const Surface& surface;
    const PlanePoints& plane;  // the points of the surface
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

  // Returns the values at new points. Each is computed from surrounding points that no outline separates from
  // it: normal and curvature from a linear fit, the depth from the chords to the nearest points.
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

  Input in_;
};

// Returns the values at points of rows, smoothed along each row. Depth, normal and curvature come from a
// quadratic that is fitted to the points of the same row within 3 rho; outliers have little weight. Points
// without a row and points with unknown values do not change.
std::vector<SideInterpolation::Value> smoothed_along_rows(std::span<const RowPoint> points,
                                                          std::vector<SideInterpolation::Value> values,
                                                          double rho);

}  // namespace relievo
