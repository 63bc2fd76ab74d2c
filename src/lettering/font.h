// Shapes texts and outlines their glyphs with HarfBuzz, in the order that FriBidi determines.
#pragma once

#include <vector>

#include "geometry/outline_union.h"
#include "relievo/lettering/ornament.h"

namespace relievo {

// Glyphs that belong together, such as a letter with its marks. Coordinates are relative to the start of the
// line and its baseline. The unit is the height of the font's capitals.
struct GlyphCluster {
  Outlines outlines;
  double begin = 0, advance = 0;
  bool is_joined = false;  // connected to its neighbours, as Arabic letters are
};

struct ShapedLine {
  std::vector<GlyphCluster> clusters;  // from left to right
  double advance = 0, x_height = 0;
};

// Returns the line of text in the ornament's font, or in the embedded font if it has none. Curves become
// polygons that deviate by at most `tolerance`, in heights of capitals. Errors: those of check_text().
Result<ShapedLine> shape_line(const Ornament& ornament, double tolerance);

}  // namespace relievo
