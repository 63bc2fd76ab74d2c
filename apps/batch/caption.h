// Writes names into pictures, in letters of 5 x 7 pixels. Tested by tests/cli/batch_pages_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "relievo/core/image.h"

namespace relievo::app::batch {

inline constexpr int caption_height_px = 9, letter_width_px = 6;

// A line of text in a picture: its left upper corner, and the width that it may take, in pixels.
struct CaptionPlace {
  int left = 0, top = 0, width = 0;
};

// Writes one line in that colour into a picture of 3 channels, in the middle of the place, which lies within
// the picture. A text that is too long loses its end, which two dots replace. Bytes that are no printable
// ASCII appear as question marks.
void write_caption(Image8& image, const CaptionPlace& place, std::string_view text,
                   const std::array<std::uint8_t, 3>& colour);

}  // namespace relievo::app::batch
