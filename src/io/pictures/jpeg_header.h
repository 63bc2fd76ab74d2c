// Reads the information that precedes the pixels in a JPEG.
#pragma once

#include <cstdint>
#include <string_view>

namespace relievo::io {

struct JpegHeader {
  std::uint64_t width = 0, height = 0;  // 0 if the bytes have no frame
  std::uint64_t channels = 0;
  int orientation = 1;  // Exif tag, see turn_upright()
};

// Returns the information in the segments up to the first frame. `bytes` is a JPEG or the beginning of one.
JpegHeader find_jpeg_header(std::string_view bytes);

}  // namespace relievo::io
