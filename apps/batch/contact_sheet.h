// Makes contact sheets: small pictures of many reliefs in one picture. Tested by
// tests/cli/batch_pages_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/image.h"

namespace relievo::app::batch {

inline constexpr std::size_t tiles_per_sheet = 144;

// Returns the pixels of a PNG, with 3 channels; empty if it cannot be read.
Image8 read_png(std::span<const std::byte> bytes);

// Returns a tile of `side` x `side` pixels with the front view of a preview, which is its left half (see
// render_preview()). The view is reduced to fit by averaging, and centred.
Image8 tile_of_preview(const Image8& preview, int side);

// A relief on a sheet.
struct Tile {
  Image8 picture;  // of tile_of_preview(), or empty for a relief that could not be made
  std::string name;
};

// Returns a sheet of the tiles, at most tiles_per_sheet, row by row, about as wide as it is high, with each
// name below its picture. Empty pictures are crossed out.
Image8 contact_sheet(const std::vector<Tile>& tiles, int side);

}  // namespace relievo::app::batch
