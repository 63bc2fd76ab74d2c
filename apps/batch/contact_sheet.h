// Makes contact sheets: pictures that show small previews of many reliefs. Tested by
// tests/cli/batch_pages_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"
#include "relievo/core/image.h"

namespace relievo::app::batch {

inline constexpr std::size_t tiles_per_sheet = 144;

// Returns the pixels of a PNG in 3 channels; an empty picture if it cannot be read.
Image8 read_png(std::span<const std::byte> bytes);

// Returns a tile of `side` x `side` pixels with the front view of a preview, which is its left half (see
// render_preview()). The view is scaled down by averaging to fit, and centred.
Image8 tile_of_preview(const Image8& preview, int side);

inline constexpr int caption_height_px = 9, letter_width_px = 6;

// The area of one line of text in a picture: its top left corner and the largest width, in pixels.
struct CaptionPlace {
  int left = 0, top = 0, width = 0;
};

// Draws one line of text into a picture of 3 channels, centred in the area, which must lie within the
// picture. A text that is too long is cut, and ends with two dots. Bytes that are not printable ASCII are
// drawn as question marks.
void write_caption(Image8& image, const CaptionPlace& place, std::string_view text,
                   const std::array<std::uint8_t, 3>& colour);

// A relief on a contact sheet.
struct Tile {
  Image8 picture;  // made by tile_of_preview(); empty if the relief could not be made
  std::string name;
};

// Returns a picture of at most tiles_per_sheet tiles, row by row, about as wide as it is high. Below each
// tile is its name. A cross replaces an empty tile.
Image8 contact_sheet(const std::vector<Tile>& tiles, int side);

}  // namespace relievo::app::batch
