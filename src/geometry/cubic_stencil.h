// Evaluates uniform cubic B-splines in the plane (section 3.1 of Lee, Wolberg and Shin, 1997) at a SplinePlace, which
// stores the position within a cell in 16 bits per axis. Tested by tests/geometry/spline_test.cpp.
#pragma once

#include <algorithm>

#include "relievo/geometry/spline.h"

namespace relievo {

using CubicRow = Eigen::Array4f;

// packed_share() converts a position within a cell, in [0, 1), to the 16 bits of a SplinePlace. unpacked_share()
// converts it back.
inline std::uint16_t packed_share(float t) {
  return static_cast<std::uint16_t>(std::clamp(t * 65536 + .5F, 0.F, 65535.F));
}
inline float unpacked_share(std::uint16_t share) {
  return static_cast<float>(share) * 0x1p-16F;
}

// Returns the values of the four basis functions at t in [0, 1], the position within a cell.
inline CubicRow cubic_basis(float t) {
  const CubicRow c0(1 / 6.F, 4 / 6.F, 1 / 6.F, 0), c1(-.5F, 0, .5F, 0), c2(.5F, -1, .5F, 0),
      c3(-1 / 6.F, .5F, -.5F, 1 / 6.F);
  return c0 + t * (c1 + t * (c2 + t * c3));
}

// The weights of the nodes around a position, along x and along y.
struct CubicStencil {
  CubicRow x, y;

  // Returns the weighted sum of 4 x 4 nodes. `node` is the first one; `columns` is the number of nodes per
  // row.
  float operator()(const float* node, std::size_t columns) const {
    using Nodes = Eigen::Map<const CubicRow>;
    CubicRow sum = y[0] * Nodes(node);
    for (int l = 1; l < 4; ++l) sum += y[l] * Nodes(node + static_cast<std::size_t>(l) * columns);
    return (sum * x).sum();
  }
};

inline CubicStencil cubic_stencil(const SplinePlace& place) {
  return {cubic_basis(unpacked_share(place.x)), cubic_basis(unpacked_share(place.y))};
}

}  // namespace relievo
