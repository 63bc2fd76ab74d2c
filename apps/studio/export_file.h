// Files of a finished relief, as the page asks for them.
#pragma once

#include <string>
#include <vector>

#include "relievo/core/length.h"
#include "relievo/make_relief.h"

namespace relievo::studio {

struct ExportedFile {
  std::string bytes, type;
};

// Whether export_file() knows the format: stl, 3mf, ply, obj, heightmap (PNG), tiff (heights) or
// preview.
bool is_format(const std::string& format);

// Returns the relief as a file of a known format, the bytes that `relievo make` writes. `heightmap_px` is the
// longer side of a height map.
ExportedFile export_file(const MadeRelief& made, const std::string& format, int heightmap_px);

struct HeightMapOrder {
  int longer_side_px = 1024;
  bool is_tiff = false;  // else PNG
  LengthUnit unit = LengthUnit::mm;
};

// Returns the height map as a file, with its scale. Of what was bent around a wrap the flat plate is shown,
// for machines that turn the stock.
std::vector<std::byte> height_map_file(const MadeRelief& made, const HeightMapOrder& order);

}  // namespace relievo::studio
