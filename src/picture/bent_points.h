// Computes the positions to which a wrap bends the points of a flat plate whose heights change from frame to
// frame. Tested by one_renderer_test.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/plate/wrap.h"

namespace relievo {

class BentPoints {
 public:
  // Prepares the points at the given positions of the flat plate, in the coordinates of Wrap::at().
  BentPoints(const Wrap& wrap, std::span<const Vec2> places);

  const Wrap& wrap() const { return wrap_; }

  // Returns the bent position of point i if it has the given height above the ground. As its height changes, a point
  // moves along a straight line.
  Vec3f at(std::size_t i, float height_mm) const { return points_[i].at + height_mm * points_[i].out; }

  // Returns the unit normal of the bent relief at point i. On the flat plate, the relief has the given
  // height and the normal `flat` there.
  Vec3f normal(std::size_t i, float height_mm, const Vec3f& flat) const;

 private:
  // A position on the ground, the direction in which heights are measured there, and the derivatives of both with
  // respect to x and y.
  struct Point {
    Vec3f at, out, at_by_x, at_by_y, out_by_x, out_by_y;
  };
  Wrap wrap_;
  std::vector<Point> points_;
};

}  // namespace relievo
