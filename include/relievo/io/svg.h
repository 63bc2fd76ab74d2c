// Reads the filled paths of SVG drawings.
#pragma once

#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

// Returns closed outlines of the drawing's filled paths, in the drawing's unit, with y upwards. The filled
// area is where their winding number is not 0. Curves become polygons whose error is at most 1/5000 of the
// drawing's longer side. Strokes and paths without fill are ignored. Errors: kind input, with the position,
// for text that is not SVG, shapes other than paths, transforms, invalid path data, and more than 50,000
// corners.
Result<std::vector<std::vector<Vec2>>> read_svg(std::string_view text, std::string_view name);

}  // namespace relievo
