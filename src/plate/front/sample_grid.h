// The grid on which a front is sampled. Tested by tests/plate/sample_front_test.cpp.
#pragma once

#include "geometry/raster.h"
#include "relievo/core/image.h"
#include "relievo/plate/solid.h"

namespace relievo {

// A grid of points over the front, and the triangle that contains each point.
struct SampleGrid {
  double step = 0;
  Vec2 corner;  // upper left
  RasterInput input;
  Image<Index> triangle;  // no_index beside the front

  Vec2 place(int x, int y) const { return {corner.x() + (x + .5) * step, corner.y() - (y + .5) * step}; }
  Vec2 pixel(const Vec2& p) const { return Vec2(p.x() - corner.x(), corner.y() - p.y()) / step; }
};

// Returns a grid whose squares have sides of `step`, or more for a large front. Its width and height are
// multiples of `block`.
SampleGrid sample_grid(const HeightFieldMesh& front, double step, int block);

}  // namespace relievo
