// Gaussian blur along a surface: over points that are near in space, so that points beyond a depth jump do
// not take part although they are near in the view plane.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A blur with a Gaussian of one width, prepared for given points. Their values are distributed to a grid of
// cells about as wide as the Gaussian, the cells are averaged with their neighbours, and the values are
// interpolated back. The time does not depend on the width.
class SurfaceBlur {
 public:
  // `sigma` > 0 is the standard deviation; it is increased if the grid would have more than 2^24 cells, or
  // more than 2^16 and 2^12 a point.
  SurfaceBlur(std::span<const Vec3> points, double sigma);

  // Replaces each value, one per point, by the average around the point.
  void apply(std::span<Vec2f> values) const;

  std::size_t number_of_cells() const { return size_[0] * size_[1] * size_[2]; }

 private:
  struct Place {
    Index cell = 0;  // the one of the eight around the point with the smallest coordinates
    Vec3f share = Vec3f::Zero();
  };
  void average_cells(std::vector<Vec3f>& cells) const;

  std::array<std::size_t, 3> size_{};
  std::vector<Place> places_;
};

}  // namespace relievo
