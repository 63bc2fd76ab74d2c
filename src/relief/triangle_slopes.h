// The slopes of the triangles between points, and the divergence of fields on them.
#pragma once

#include <span>
#include <vector>

#include "relievo/geometry/triangulation.h"
#include "relievo/scan/boundary.h"

namespace relievo {

// The triangles inside a relief, except those with all corners on the boundary. Slopes are (dz/dx, dz/dy).
class TriangleSlopes {
 public:
  TriangleSlopes(std::span<const Vec2> points, const Triangulation& triangulation, const Boundary& boundary);

  // Returns the number of triangles.
  std::size_t size() const { return triangles_.size(); }

  // Returns the slope of triangle t under heights, one per point.
  template <typename Real>
  Eigen::Vector2<Real> slope(std::size_t t, std::span<const Real> heights) const {
    const auto& [corners, first, second] = triangles_[t];
    const Real last = heights[corners[2]];
    return (heights[corners[0]] - last) * first.template cast<Real>() +
           (heights[corners[1]] - last) * second.template cast<Real>();
  }

  // Writes sums[i] = sum over the triangles around point i of area times field . gradient of i's hat
  // function; 0 at boundary points. For a field of slopes that is the right-hand side of equation (9) without
  // jump weights.
  void divergence(std::span<const Vec2f> field, std::span<float> sums) const;

 private:
  struct Corners {
    Triangle corners;
    Vec2f first = Vec2f::Zero(),
          second = Vec2f::Zero();  // gradients of the hat functions of the first two corners
  };
  struct Share {
    Index triangle = 0;
    Vec2f weight = Vec2f::Zero();  // area times gradient
  };

  std::vector<Corners> triangles_;
  std::vector<Index> begin_;  // shares of point i: shares_[begin_[i]] up to shares_[begin_[i + 1]]
  std::vector<Share> shares_;
};

}  // namespace relievo
