// Reads the filled paths of SVG drawings.
#pragma once

#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// Returns closed outlines of the drawing's filled paths in its own unit, y up; together they cover where their
// winding number is not 0. Curves become polygons that differ from them by at most a 5000th of the drawing. Strokes
// are ignored, and so are paths without a fill. Errors: kind input, with the place, for text that is no SVG, other
// shapes than paths, transforms, path data that cannot be read, and more than 50,000 corners.
Result<std::vector<std::vector<Vec2>>> read_svg(std::string_view text, std::string_view name);

}  // namespace relievo
