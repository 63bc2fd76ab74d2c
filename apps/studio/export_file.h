// Files of a finished relief, as the page asks for them.
#pragma once

#include <string>

#include "relievo/solid.h"

namespace relievo::studio {

struct ExportedFile {
  std::string bytes, type;
};

// Whether export_file() knows the format: stl, 3mf, ply, obj, heightmap (PNG), tiff (heights) or
// preview.
bool is_format(const std::string& format);

// Returns the solid as a file of a known format, the bytes that `relievo make` writes. `heightmap_px` is the
// longer side of a height map.
ExportedFile export_file(const Solid& solid, const std::string& format, int heightmap_px);

}  // namespace relievo::studio
