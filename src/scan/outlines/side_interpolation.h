// Interpolates a surface from the points on one side of its outlines. Tested by tests/scan/outlines_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "scan/outlines/outlines.h"
#include "scan/outlines/row_points.h"

namespace relievo {

// Measures of the surface's points that only the stages until the boundary need.
struct PointMeasures {
  std::vector<double> k;       // mean curvature, 0 at hole fill points
  std::vector<float> spacing;  // Spacing::local of clouds of uneven density, else none
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
    double k = 0;
    float spacing = 0;
  };

  // Returns the values at a new point. Normal and curvature come from a linear fit to the points around it
  // that no outline separates from it, the depth from the chords to the nearest of these points.
  Value at(const RowPoint& p) const;

 private:
  using Match = KdTree<Vec2>::Match;

  void leave_same_side(const RowPoint& p, std::vector<Match>& matches) const;
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
