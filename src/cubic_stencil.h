// Uniform cubic B-splines in the plane, at packed places. Section 3.1 of Lee, Wolberg and Shin, 1997.
#pragma once

#include "relievo/spline.h"

namespace relievo {

using CubicRow = Eigen::Array4f;

// The four that count at t in [0, 1] of a cell.
inline CubicRow cubic_basis(float t) {
  const CubicRow c0(1 / 6.F, 4 / 6.F, 1 / 6.F, 0), c1(-.5F, 0, .5F, 0), c2(.5F, -1, .5F, 0),
      c3(-1 / 6.F, .5F, -.5F, 1 / 6.F);
  return c0 + t * (c1 + t * (c2 + t * c3));
}

// A place's weights in x and y.
struct CubicStencil {
  CubicRow x, y;

  // The sum over 4 x 4 nodes, of which the first is given.
  float operator()(const float* node, std::size_t columns) const {
    using Nodes = Eigen::Map<const CubicRow>;
    CubicRow sum = y[0] * Nodes(node);
    for (int l = 1; l < 4; ++l) sum += y[l] * Nodes(node + static_cast<std::size_t>(l) * columns);
    return (sum * x).sum();
  }
};

inline CubicStencil cubic_stencil(const SplinePlace& place) {
  return {cubic_basis(static_cast<float>(place.x) * 0x1p-16F),
          cubic_basis(static_cast<float>(place.y) * 0x1p-16F)};
}

}  // namespace relievo
