// Makes height maps of a solid's front. The values of a height map are either grey levels or heights in
// millimetres.
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
  relief  // only the relief, without the rim and the flat ground around it
};

inline constexpr std::array<Choice<MapArea>, 2> map_area_choices{
    {{"plate", MapArea::plate}, {"relief", MapArea::relief}}};

// The height that is 0 in a height map.
enum class MapZero { lowest, ground };

inline constexpr std::array<Choice<MapZero>, 2> map_zero_choices{
    {{"lowest", MapZero::lowest}, {"ground", MapZero::ground}}};

struct HeightMapOptions {
  int longer_side_px = 1024;
  double mm_per_pixel = 0;  // exact size of a pixel; if 0, longer_side_px decides
  MapArea area = MapArea::plate;
  MapZero zero = MapZero::lowest;
  bool is_inverted = false;  // true if 0 is the highest point and values increase downwards
};

struct HeightMap {
  Image16 image;            // grey levels from 0 to 2^bits - 1
  double mm_per_pixel = 0;  // size of a pixel in x and y
  double mm_per_grey = 0;   // height of one grey level
  int bits = 16;
};

// Heights in millimetres, row-major, with the first row at the top.
struct HeightsMm {
  Image<float> image;
  double mm_per_pixel = 0;
  HeightMapOptions options = {};  // options for which the heights were made
  double span_mm = 0;             // height of the highest point above the zero height
  std::string note = {};          // text that is appended to the description in a file
};

// Returns the front of a solid as heights above the zero height (MapZero) of the options, or as depths below
// the front's highest point. A pixel has the height of the solid's triangle at the pixel's centre, also on
// the outline. Pixels beside the plate have the height of the front's lowest point. If only the relief is
// shown, pixels beside it have the height of the ground. The shown part is centred in the picture. The result
// has no pixels if the solid is empty, or if the number of pixels along a side would not be in [1, 32768].
HeightsMm make_heights_mm(const Solid& solid, const HeightMapOptions& options);

// Returns the heights as grey levels of 8 or 16 bits. The range of heights uses all grey levels. Heights
// below the zero height get the grey level of the zero height. If no point is above the zero height, all
// pixels get level 0.
HeightMap grey_levels(const HeightsMm& heights, int bits = 16);

// Returns the image of the map with 8 bits per grey level.
Image8 in_8_bits(const HeightMap& map);

// Returns the number of different grey levels in the picture.
int count_greys(const HeightMap& map);

// Returns a shaded picture of the front from above. Material that the tool leaves is orange where it is thin,
// and red where it is as thick as the largest residual. The result has no pixels if there are no samples.
Image8 render_reach(const ToolReach& reach, int longer_side_px);

}  // namespace relievo
