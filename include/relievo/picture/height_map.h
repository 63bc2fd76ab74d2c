// Height maps of a solid's front: in grey for machines and pictures, or in millimetres.
#pragma once

#include <string>

#include "relievo/core/image.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"

namespace relievo {

struct HeightMap {
  Image16 image;            // 0 is the lowest point of the front, 65535 the highest
  double mm_per_pixel = 0;  // size of a pixel in x and y
  double mm_per_grey = 0;   // height of one grey step
};

// Returns the front of a solid as a height map whose longer side has `longer_side_px` pixels; each pixel has
// the height of the solid's triangle under its centre, the outline included, or 0 beside the plate. The
// front's box lies in the middle of the picture. A flat front gives zeros. The result has no pixels for an
// empty solid or a side not in [1, 32768].
HeightMap make_height_map(const Solid& solid, int longer_side_px);

// Heights in millimetres above the lowest point of the front, row-major, first row at the top.
struct HeightsMm {
  Image<float> image;
  double mm_per_pixel = 0;
  std::string note = {};  // text to append to the description in a file
};

// Returns the front of a solid as heights, see make_height_map().
HeightsMm make_heights_mm(const Solid& solid, int longer_side_px);

// Returns a shaded picture of the front from above. Material that the tool leaves is coloured from orange to
// red, by its share of the largest residual. The result has no pixels if there are no samples.
Image8 render_reach(const ToolReach& reach, int longer_side_px);

}  // namespace relievo
