// Small letters for pictures.
#pragma once

#include <string_view>

#include "relievo/core/image.h"
#include "relievo/picture/preview.h"

namespace relievo::app::cli {

inline constexpr int letter_width_px = 12, letter_height_px = 20;  // with the gaps between

// Writes a line of text with its upper left corner at the place given; what is outside the picture is left
// out, and what is no letter, digit or one of .,%-+/:()= is blank.
void write_text(Image8& image, int x, int y, std::string_view text, std::uint8_t grey);

}  // namespace relievo::app::cli
