// Computes where a wrap bends the points of a flat plate whose heights change from frame to frame. Tested by
// one_renderer_test.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/plate/wrap.h"

namespace relievo {

class BentPoints {
 public:
  // Prepares the points at these places of the flat plate, in the coordinates of Wrap::at().
  BentPoints(const Wrap& wrap, std::span<const Vec2> places);

  const Wrap& wrap() const { return wrap_; }

  // Returns the bent position of point i at this height above the ground. A wrap moves a point along a straight line
  // as its height changes.
  Vec3f at(std::size_t i, float height_mm) const { return points_[i].at + height_mm * points_[i].out; }

  // Returns the unit normal at point i of a relief that has this height and this normal on the flat plate.
  Vec3f normal(std::size_t i, float height_mm, const Vec3f& flat) const;

 private:
  // A position on the ground, and the direction in which heights are measured there, with their derivatives by x and y.
  struct Point {
    Vec3f at, out, at_by_x, at_by_y, out_by_x, out_by_y;
  };
  Wrap wrap_;
  std::vector<Point> points_;
};

}  // namespace relievo
