// Averages along a surface: over what is near in space, so that what lies behind, beyond a depth jump, does
// not take part.
#pragma once

#include <span>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

// A Gaussian in space of one width, prepared for fixed points: they are spread over a grid of cells about as
// wide as the Gaussian, the cells are averaged with their neighbours and the points read back. Time does not
// depend on the width.
class SurfaceBlur {
 public:
  // `sigma` > 0 is the standard deviation; it is widened where the grid would have more than 2^24 cells.
  SurfaceBlur(std::span<const Vec3> points, double sigma);

  // Replaces each value, one per point, by the average around the point.
  void apply(std::span<Vec2f> values) const;

 private:
  struct Place {
    Index cell = 0;  // with the smallest coordinates of the eight around the point
    Vec3f share = Vec3f::Zero();
  };
  void average_cells(std::vector<Vec3f>& cells) const;

  std::array<std::size_t, 3> size_{};
  std::vector<Place> places_;
};

}  // namespace relievo
