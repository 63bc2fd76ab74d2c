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

// Decodes a PNG to a picture of 3 channels. Returns an empty picture if the bytes cannot be read.
Image8 read_png(std::span<const std::byte> bytes);

// Returns a tile of `side` x `side` pixels that shows the front view of a preview. This view is the left half
// of the preview (see render_preview()). It is scaled down until it fits, by averaging pixels, and centred.
Image8 tile_of_preview(const Image8& preview, int side);

inline constexpr int caption_height_px = 9, letter_width_px = 6;

// The area of one line of text in a picture: its top left corner and the largest width, in pixels.
struct CaptionPlace {
  int left = 0, top = 0, width = 0;
};

// Draws one line of text into a picture of 3 channels. The text is centred in the area `place`, which must
// lie within the picture. A text that is too long is cut, and ends with two dots. Bytes that are not
// printable ASCII are drawn as question marks.
void write_caption(Image8& image, const CaptionPlace& place, std::string_view text,
                   const std::array<std::uint8_t, 3>& colour);

// A relief on a contact sheet.
struct Tile {
  Image8 picture;  // made by tile_of_preview(); empty if the relief could not be made
  std::string name;
};

// Draws at most tiles_per_sheet tiles row by row into one picture, which is about as wide as it is high. Below
// each tile is its name. A tile without a picture shows a cross.
Image8 contact_sheet(const std::vector<Tile>& tiles, int side);

}  // namespace relievo::app::batch
