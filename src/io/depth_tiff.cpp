#include <algorithm>
#include <array>
#include <cstring>

#include "io/numbers.h"
#include "io/pictures.h"
#include "io/text.h"
#include "io/tiff_bytes.h"

namespace relievo::io {
namespace {

struct Layout {
  std::uint32_t width = 0, height = 0, tile_width = 0, tile_height = 0;
  std::uint16_t bits = 1, kind = SAMPLEFORMAT_UINT, channels = 1;
};

Layout layout_of(TIFF* tiff) {
  Layout it;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &it.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &it.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &it.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &it.kind);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &it.channels);
  if (!TIFFIsTiled(tiff)) return it;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &it.tile_width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &it.tile_height);
  return it;
}

std::optional<NumberType> type_of(const Layout& layout) {
  using enum NumberType;
  if (layout.kind == SAMPLEFORMAT_IEEEFP && layout.bits == 32) return float32;
  if (layout.kind == SAMPLEFORMAT_INT && layout.bits == 16) return int16;
  if (layout.kind != SAMPLEFORMAT_UINT) return std::nullopt;
  if (layout.bits == 8) return uint8;
  return layout.bits == 16 ? std::optional(uint16) : std::nullopt;
}

// libtiff converts numbers to the machine's byte order, which is little-endian here.
void decode_run(NumberType type, const char* from, std::size_t n, float* to) {
  std::vector<double> values(n);
  decoder(type, false)(from, size_in_bytes(type), n, values.data());
  std::transform(values.begin(), values.end(), to, [](double v) { return static_cast<float>(v); });
}

bool read_lines(TIFF* tiff, const Layout& layout, NumberType type, DepthImage& image) {
  std::vector<char> line(static_cast<std::size_t>(TIFFScanlineSize64(tiff)));
  if (line.size() < layout.width * size_in_bytes(type)) return false;
  for (std::uint32_t r = 0; r < layout.height; ++r) {
    if (TIFFReadScanline(tiff, line.data(), r) != 1) return false;
    decode_run(type, line.data(), layout.width,
               image.values.pixels.data() + image.values.index(0, static_cast<int>(r)));
  }
  return true;
}

bool read_tiles(TIFF* tiff, const Layout& layout, NumberType type, DepthImage& image) {
  const std::size_t row = layout.tile_width * size_in_bytes(type);
  const auto size = static_cast<std::size_t>(TIFFTileSize64(tiff));
  if (layout.tile_width == 0 || layout.tile_height == 0 || size > most_pixels * 4 ||
      size < row * layout.tile_height)
    return false;
  std::vector<char> tile(size);
  for (std::uint32_t y = 0; y < layout.height; y += layout.tile_height)
    for (std::uint32_t x = 0; x < layout.width; x += layout.tile_width) {
      if (TIFFReadTile(tiff, tile.data(), x, y, 0, 0) < 0) return false;
      const std::uint32_t columns = std::min(layout.tile_width, layout.width - x);
      for (std::uint32_t r = 0; r < std::min(layout.tile_height, layout.height - y); ++r)
        decode_run(type, tile.data() + r * row, columns,
                   &image.values.at(static_cast<int>(x), static_cast<int>(y + r)));
    }
  return true;
}

}  // namespace

// Classic TIFF has version 42, BigTIFF version 43, each in either byte order.
bool is_tiff(const Source& source) {
  using namespace std::string_view_literals;
  return std::ranges::any_of(std::array{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv},
                             [&](std::string_view mark) { return source.bytes.starts_with(mark); });
}

Result<DepthImage> read_depth_tiff(const Source& source) {
  TiffBytes file(source.bytes);
  const auto broken = [&] {
    return source.error({}, "expected the data of a TIFF picture, found " +
                                (file.message().empty() ? "too little" : printable(file.message())));
  };
  if (!file.handle()) return broken();
  const Layout layout = layout_of(file.handle());
  const std::size_t pixels = std::size_t{layout.width} * layout.height;
  if (pixels > most_pixels)
    return source.error({}, "expected at most 134217728 pixels, found " + std::to_string(pixels));
  if (pixels / best_packing > source.bytes.size())
    return source.error({}, "expected more data for " + std::to_string(pixels) + " pixels");
  if (layout.channels != 1)
    return source.error({}, "expected one channel of depths, found " + std::to_string(layout.channels));
  const auto type = type_of(layout);
  if (!type)
    return source.error({}, "expected 8 or 16 bits or float32, found " + std::to_string(layout.bits) +
                                " bits of another kind");
  DepthImage image{
      {}, *type == NumberType::float32 ? 0.0 : 1.0, "TIFF, " + std::to_string(layout.bits) + " bits"};
  image.values.resize(static_cast<int>(layout.width), static_cast<int>(layout.height));
  const bool is_read = TIFFIsTiled(file.handle()) ? read_tiles(file.handle(), layout, *type, image)
                                                  : read_lines(file.handle(), layout, *type, image);
  if (!is_read) return broken();
  return image;
}

}  // namespace relievo::io
