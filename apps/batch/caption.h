// Draws captions into pictures, in letters of 5 x 7 pixels. Tested by tests/cli/batch_pages_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "relievo/core/image.h"

namespace relievo::app::batch {

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

}  // namespace relievo::app::batch
