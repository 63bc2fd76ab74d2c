// The grid on which a front is sampled. Tested by tests/plate/sample_front_test.cpp.
#pragma once

#include "geometry/raster.h"
#include "relievo/core/image.h"
#include "relievo/plate/solid.h"

namespace relievo {

// The places of a grid over the front, and which triangle each lies in.
struct SampleGrid {
  double step = 0;
  Vec2 corner;  // upper left
  RasterInput input;
  Image<Index> triangle;  // no_index beside the front

  Vec2 place(const Vec2& pixel) const {
    return {corner.x() + pixel.x() * step, corner.y() - pixel.y() * step};
  }
  Vec2 place(int x, int y) const { return place(Vec2(x + .5, y + .5)); }
  Vec2 pixel(const Vec2& p) const { return Vec2(p.x() - corner.x(), corner.y() - p.y()) / step; }
};

// Returns a grid whose squares have sides of `step` or, of a large front, more; `block` divides its width and height.
SampleGrid sample_grid(const HeightFieldMesh& front, double step, int block);

}  // namespace relievo
