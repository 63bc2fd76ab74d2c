// Reads uncompressed Windows BMP pictures: palettes of 1, 4 and 8 bits, colours of 24 and 32 bits.
#include <cstdlib>

#include "io/pictures/pictures.h"
#include "io/pictures/samples.h"

namespace relievo::io {
namespace {

constexpr std::size_t file_header_bytes = 14, info_header_bytes = 40;

struct BmpHeader {
  std::uint64_t pixels = 0, palette = 0;  // offsets in the file
  std::int64_t width = 0, height = 0;     // a negative height means that the first row is at the top
  std::uint64_t bits = 0, compression = 0, row_bytes = 0;

  bool has_palette() const { return bits <= 8; }
};

BmpHeader bmp_header_of(const Source& source) {
  const auto number = [&](std::size_t at, unsigned bytes) {
    return whole_number(source.bytes.data() + at, bytes, false);
  };
  const auto signed_number = [&](std::size_t at) {
    return std::int64_t{static_cast<std::int32_t>(number(at, 4))};
  };
  BmpHeader header{number(10, 4),     file_header_bytes + number(14, 4),
                   signed_number(18), signed_number(22),
                   number(28, 2),     number(30, 4)};
  header.row_bytes = (static_cast<std::uint64_t>(std::abs(header.width)) * header.bits + 31) / 32 * 4;
  return header;
}

Result<void> check_header(const Source& source, const BmpHeader& header) {
  constexpr std::uint64_t no_compression = 0, masks = 3;
  const bool is_plain =
      header.compression == no_compression || (header.compression == masks && header.bits == 32);
  const bool is_known =
      header.bits == 1 || header.bits == 4 || header.bits == 8 || header.bits == 24 || header.bits == 32;
  if (!is_plain || !is_known)
    return source.error(
        {}, cat("expected a BMP of 1, 4, 8, 24 or 32 bits without compression, found ", header.bits, " bits",
                is_plain ? "" : " with compression", "; save it as PNG"));
  if (header.width <= 0 || header.height == 0)
    return source.error_at_byte(
        18, cat("expected width and height, found ", header.width, " and ", header.height));
  const auto rows = static_cast<std::uint64_t>(std::abs(header.height));
  RELIEVO_CHECK(check_room(source, {static_cast<std::uint64_t>(header.width), rows, 0, 0}));
  return check_room(source, {1, 1, header.row_bytes * rows, header.pixels});
}

// Returns the colour of a pixel; `row` is the offset of its row. The file has the order blue, green, red.
// Colours missing in a palette are black.
PixelColour bmp_colour(const Source& source, const BmpHeader& header, std::uint64_t row,
                       std::uint64_t column) {
  const std::uint64_t bit = column * header.bits;
  std::uint64_t at = row + bit / 8;
  const auto byte = [&](std::uint64_t i) {
    return i < source.bytes.size() ? static_cast<unsigned char>(source.bytes[i]) : 0U;
  };
  if (header.has_palette()) {
    const std::uint64_t index = byte(at) >> (8 - header.bits - bit % 8) & ((1U << header.bits) - 1);
    at = header.palette + 4 * index;
    if (at + 4 > header.pixels) return {};
  }
  return {static_cast<float>(byte(at + 2)), static_cast<float>(byte(at + 1)), static_cast<float>(byte(at))};
}

}  // namespace

bool is_bmp(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (!bytes.starts_with("BM") || bytes.size() < file_header_bytes + info_header_bytes) return false;
  const std::uint64_t header_bytes = whole_number(bytes.data() + file_header_bytes, 4, false);
  return header_bytes >= info_header_bytes && header_bytes <= 124;  // versions 3 to 5
}

Result<DepthImage> read_depth_bmp(const Source& source, const PictureChannels& wanted) {
  const BmpHeader header = bmp_header_of(source);
  RELIEVO_CHECK(check_header(source, header));
  DepthImage image{{}, 1, cat("BMP, ", header.bits, " bits")};
  image.values.resize(static_cast<int>(header.width), static_cast<int>(std::abs(header.height)));
  const auto width = static_cast<std::size_t>(header.width),
             rows = static_cast<std::size_t>(std::abs(header.height));
  RELIEVO_CHECK(fill_values(source, wanted, 3, image.values, [&](std::size_t i) {
    const std::size_t row = header.height > 0 ? rows - 1 - i / width : i / width;
    return bmp_colour(source, header, header.pixels + row * header.row_bytes, i % width);
  }));
  return image;
}

}  // namespace relievo::io
