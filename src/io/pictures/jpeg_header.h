// What a JPEG says about itself before its pixels.
#pragma once

#include <cstdint>
#include <string_view>

namespace relievo::io {

struct JpegHeader {
  std::uint64_t width = 0, height = 0;  // 0 if the bytes have no frame
  std::uint64_t channels = 0;
  int orientation = 1;  // the tag of Exif, as turn_upright() takes it
};

// Returns what stands in the segments up to the first frame, in a JPEG or in its beginning.
JpegHeader find_jpeg_header(std::string_view bytes);

}  // namespace relievo::io
