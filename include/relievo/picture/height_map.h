// Height maps of a solid's front: in grey for machines and pictures, or in millimetres.
#pragma once

#include <array>
#include <string>

#include "relievo/core/choice.h"
#include "relievo/core/image.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"

namespace relievo {

// The part of a front that a height map shows.
enum class MapArea {
  plate,
  relief  // without the flat ground around the relief, and without the rim
};

inline constexpr std::array<Choice<MapArea>, 2> map_area_choices{
    {{"plate", MapArea::plate}, {"relief", MapArea::relief}}};

// The height that is 0 in a height map.
enum class MapZero { lowest, ground };

inline constexpr std::array<Choice<MapZero>, 2> map_zero_choices{
    {{"lowest", MapZero::lowest}, {"ground", MapZero::ground}}};

struct HeightMapOptions {
  int longer_side_px = 1024;
  double mm_per_pixel = 0;  // exact size of a pixel, in place of longer_side_px; 0 if it is not given
  MapArea area = MapArea::plate;
  MapZero zero = MapZero::lowest;
  bool is_inverted = false;  // true if the highest point is 0, and values grow downwards from it
};

struct HeightMap {
  Image16 image;            // from 0 to the largest grey of `bits`
  double mm_per_pixel = 0;  // size of a pixel in x and y
  double mm_per_grey = 0;   // height of one grey step
  int bits = 16;
};

// Heights in millimetres, row-major, first row at the top.
struct HeightsMm {
  Image<float> image;
  double mm_per_pixel = 0;
  HeightMapOptions options = {};  // with which the heights were made
  double span_mm = 0;             // from the zero to the highest point
  std::string note = {};          // text to append to the description in a file
};

// Returns the front of a solid as heights above the zero of the options, or as depths below its highest point.
// Each pixel has the height of the solid's triangle under its centre, the outline included, or that of the
// front's lowest point beside the plate, and of the ground beside a relief that is shown alone. The shown part
// lies in the middle of the picture. The result has no pixels for an empty solid, or if a side would have a
// number of pixels not in [1, 32768].
HeightsMm make_heights_mm(const Solid& solid, const HeightMapOptions& options);

// Returns the heights as grey levels of 8 or 16 bits. The span takes all greys; what is lower than the zero
// becomes the grey of the zero. Heights without a span give the grey of the zero.
HeightMap grey_levels(const HeightsMm& heights, int bits = 16);

// Returns the picture of a map of 8 bits.
Image8 in_8_bits(const HeightMap& map);

// Returns the number of different greys in the picture.
int count_greys(const HeightMap& map);

// Returns a shaded picture of the front from above. Material that the tool leaves is coloured from orange to
// red, by its share of the largest residual. The result has no pixels if there are no samples.
Image8 render_reach(const ToolReach& reach, int longer_side_px);

}  // namespace relievo
