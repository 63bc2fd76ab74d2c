#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "io/pictures/geotiff.h"
#include "io/pictures/pictures.h"
#include "io/pictures/tiff_bytes.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::uint32_t gdal_no_data = 42113;  // tag with the value for missing depths, as a text

struct Layout {
  std::uint32_t width = 0, height = 0, tile_width = 0, tile_height = 0;
  std::uint16_t bits = 1, kind = SAMPLEFORMAT_UINT, channels = 1, colours = PHOTOMETRIC_MINISBLACK,
                planes = PLANARCONFIG_CONTIG, orientation = ORIENTATION_TOPLEFT;
  SampleFormat samples = {};
  std::optional<std::uint16_t> alpha;  // index of the channel of opacity
};

// Returns the first extra channel that the file declares as opacity. Extra channels come after all others.
std::optional<std::uint16_t> alpha_of(TIFF* tiff, std::uint16_t channels) {
  std::uint16_t count = 0;
  const std::uint16_t* kinds = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds) != 1 || !kinds || count >= channels)
    return std::nullopt;
  for (std::uint16_t i = 0; i < count; ++i)
    if (kinds[i] == EXTRASAMPLE_ASSOCALPHA || kinds[i] == EXTRASAMPLE_UNASSALPHA)
      return static_cast<std::uint16_t>(channels - count + i);
  return std::nullopt;
}

Layout layout_of(TIFF* tiff) {
  Layout it;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &it.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &it.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &it.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &it.kind);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &it.channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &it.planes);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &it.colours);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &it.orientation);
  it.alpha = alpha_of(tiff, it.channels);
  if (!TIFFIsTiled(tiff)) return it;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &it.tile_width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &it.tile_height);
  return it;
}

std::string name_of_colours(std::uint16_t photometric) {
  switch (photometric) {
    case PHOTOMETRIC_PALETTE:
      return "a palette";
    case PHOTOMETRIC_SEPARATED:
      return "colours of inks (CMYK)";
    case PHOTOMETRIC_YCBCR:
      return "brightness and differences of colours (YCbCr)";
    case PHOTOMETRIC_CIELAB:
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB:
      return "colours of CIELab";
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV:
      return "logarithms of brightness";
    default:
      return "colours of kind " + std::to_string(photometric);
  }
}

bool takes_luminance(const Layout& layout, const PictureChannels& wanted) {
  return wanted.is_luminance_wanted && wanted.channel == 0 && layout.colours == PHOTOMETRIC_RGB &&
         layout.channels >= 3;
}

std::unexpected<Error> several_channels(const Source& source, const Layout& layout) {
  return source.error({}, cat("expected one channel of depths, found ", layout.channels, way_out_of_colours));
}

// Returns whether red, green and blue have to be equal, as in a grey picture that was saved in colours.
bool must_be_grey(const Layout& layout, const PictureChannels& wanted) {
  return layout.colours == PHOTOMETRIC_RGB && layout.channels >= 3 && wanted.channel == 0 &&
         !wanted.is_luminance_wanted;
}

// Sets the format of the samples, or returns an error that explains why they are not depths.
Result<void> check_samples(const Source& source, Layout& layout, const PictureChannels& wanted) {
  const bool is_grey = layout.colours <= PHOTOMETRIC_MINISBLACK || layout.colours == PHOTOMETRIC_RGB;
  if (!is_grey)
    return source.error({}, cat("expected a grey picture of depths, found ", name_of_colours(layout.colours),
                                "; save it in shades of grey"));
  if (wanted.channel > layout.channels)
    return source.error({},
                        cat("expected a channel from 1 to ", layout.channels, ", found ", wanted.channel));
  const bool is_one_enough = wanted.channel > 0 || layout.channels == 1 || layout.channels == 2;
  if (!is_one_enough && !takes_luminance(layout, wanted) && !must_be_grey(layout, wanted))
    return several_channels(source, layout);
  const auto samples = find_sample_format(layout.kind, layout.bits);
  if (!samples)
    return source.error({},
                        "expected whole numbers of 1 to 32 or 64 bits, or fractions of 16, 32 or 64, found " +
                            describe_samples(layout.kind, layout.bits));
  layout.samples = *samples;
  return {};
}

// Returns the number of samples per pixel within a row.
std::size_t samples_per_pixel(const Layout& layout) {
  return layout.planes == PLANARCONFIG_CONTIG ? layout.channels : 1;
}

std::size_t row_size(const Layout& layout, std::size_t pixels) {
  return (pixels * samples_per_pixel(layout) * layout.bits + 7) / 8;
}

// Returns a row of the channel. With separate planes, a row contains only that channel.
SampleRow row_of(const Layout& layout, const unsigned char* bytes, std::uint16_t channel) {
  const bool has_all = layout.planes == PLANARCONFIG_CONTIG;
  return {bytes, has_all ? std::size_t{channel} : 0, samples_per_pixel(layout)};
}

// The index of a strip or tile that cannot be read.
using Broken = std::optional<std::uint32_t>;

Broken read_lines(TIFF* tiff, const Layout& layout, std::uint16_t channel, Image<float>& to) {
  std::vector<unsigned char> line(static_cast<std::size_t>(TIFFScanlineSize64(tiff)));
  if (line.size() < row_size(layout, layout.width)) return 0;
  for (std::uint32_t r = 0; r < layout.height; ++r) {
    if (TIFFReadScanline(tiff, line.data(), r, channel) != 1) return TIFFComputeStrip(tiff, r, channel);
    decode_samples(layout.samples, row_of(layout, line.data(), channel), layout.width,
                   to.pixels.data() + to.index(0, static_cast<int>(r)));
  }
  return {};
}

Broken read_tiles(TIFF* tiff, const Layout& layout, std::uint16_t channel, Image<float>& to) {
  const std::size_t row = row_size(layout, layout.tile_width);
  const auto size = static_cast<std::size_t>(TIFFTileSize64(tiff));
  if (layout.tile_width == 0 || layout.tile_height == 0 || size > most_pixels * 4 ||
      size < row * layout.tile_height)
    return 0;
  std::vector<unsigned char> tile(size);
  for (std::uint32_t y = 0; y < layout.height; y += layout.tile_height)
    for (std::uint32_t x = 0; x < layout.width; x += layout.tile_width) {
      if (TIFFReadTile(tiff, tile.data(), x, y, 0, channel) < 0)
        return TIFFComputeTile(tiff, x, y, 0, channel);
      const std::uint32_t columns = std::min(layout.tile_width, layout.width - x);
      for (std::uint32_t r = 0; r < std::min(layout.tile_height, layout.height - y); ++r)
        decode_samples(layout.samples, row_of(layout, tile.data() + r * row, channel), columns,
                       &to.at(static_cast<int>(x), static_cast<int>(y + r)));
    }
  return {};
}

Broken read_channel(TIFF* tiff, const Layout& layout, std::uint16_t channel, Image<float>& to) {
  to.resize(static_cast<int>(layout.width), static_cast<int>(layout.height));
  return (TIFFIsTiled(tiff) ? read_tiles : read_lines)(tiff, layout, channel, to);
}

Broken read_luminance(TIFF* tiff, const Layout& layout, Image<float>& to) {
  to.resize(static_cast<int>(layout.width), static_cast<int>(layout.height));
  Image<float> one;
  for (std::uint16_t c = 0; c < 3; ++c) {
    if (const Broken broken = read_channel(tiff, layout, c, one)) return broken;
    for (std::size_t i = 0; i < one.size(); ++i) to[i] += luminance_shares[c] * one[i];
  }
  return {};
}

// Sets `is_grey` to whether green and blue are equal to red, which is in `red`.
Broken compare_colours(TIFF* tiff, const Layout& layout, const Image<float>& red, bool& is_grey) {
  const auto is_same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  Image<float> other;
  is_grey = true;
  for (std::uint16_t c = 1; c < 3 && is_grey; ++c) {
    if (const Broken broken = read_channel(tiff, layout, c, other)) return broken;
    is_grey = std::ranges::equal(other.pixels, red.pixels, is_same);
  }
  return {};
}

// Removes the values of pixels that are more transparent than opaque.
Broken remove_transparent(TIFF* tiff, const Layout& layout, Image<float>& image) {
  Image<float> alpha;
  if (const Broken broken = read_channel(tiff, layout, *layout.alpha, alpha)) return broken;
  const double most = layout.samples.kind == SampleKind::fraction ? 1 : std::exp2(layout.bits) - 1;
  for (std::size_t i = 0; i < alpha.size(); ++i)
    if (alpha[i] < most / 2) image[i] = std::numeric_limits<float>::quiet_NaN();
  return {};
}

// Selects the first picture that is neither a smaller version nor a mask of another one. If there is none,
// the first picture stays selected.
void choose_directory(TIFF* tiff) {
  constexpr tdir_t most_directories = 1000;  // limit, because each directory is read
  for (tdir_t i = 0; i < most_directories && (i == 0 || TIFFReadDirectory(tiff)); ++i) {
    std::uint32_t kind = 0;
    TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &kind);
    if ((kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) == 0) return;
  }
  TIFFSetDirectory(tiff, 0);
}

std::string in_words_of_libtiff(const TiffBytes& file) {
  return "expected the data of a TIFF picture; libtiff says: " + printable(file.message(), 120);
}

// Returns an error that explains why a strip or tile cannot be read. Usually the file is truncated, which
// libtiff's own messages do not say.
std::unexpected<Error> broken_part(const Source& source, const TiffBytes& file, std::uint32_t number) {
  const std::string place = cat(TIFFIsTiled(file.handle()) ? "tile " : "strip ", number);
  const std::uint64_t first = TIFFGetStrileOffset(file.handle(), number),
                      size = TIFFGetStrileByteCount(file.handle(), number), end = source.bytes.size();
  if (first > end || size > end - first)
    return source.error(place, cat("expected ", size, " bytes from byte ", first, " on, found ",
                                   end - std::min(first, end), "; the file is cut, get it anew"));
  return source.error(place, file.message().empty() ? "expected the rows of a picture, found none"
                                                    : in_words_of_libtiff(file));
}

// Returns an error that explains why libtiff finds no picture in the file.
std::unexpected<Error> no_directory(const Source& source, const TiffBytes& file) {
  const std::string_view bytes = source.bytes;
  const bool is_big = bytes.size() >= 16 && (bytes[2] == '+' || bytes[3] == '+'),
             is_swapped = bytes[0] == 'M';
  const std::size_t at = is_big ? 8 : 4, size = is_big ? 8 : 4;
  std::uint64_t first = 0;
  for (std::size_t i = 0; i < size && at + size <= bytes.size(); ++i)
    first |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << 8 * (is_swapped ? size - 1 - i : i);
  if (first == 0 && bytes.size() >= at + size)
    return source.error_at_byte(at,
                                "expected the place of the picture's tags, found 0; the file has no "
                                "picture, save it anew");
  if (first < bytes.size()) return source.error_at_byte(first, in_words_of_libtiff(file));
  return source.error_at_byte(at,
                              cat("expected the place of the picture's tags below ", bytes.size(),
                                  ", the size of the file, found ", first, "; the file is cut, get it anew"));
}

// Returns the value for missing depths, if the file has GDAL's tag for it.
std::optional<float> no_data(TIFF* tiff) {
  std::uint32_t size = 0;
  const char* text = nullptr;
  if (TIFFGetField(tiff, gdal_no_data, &size, &text) != 1 || !text) return std::nullopt;
  const std::string_view whole(text, size);
  const auto value = parse_number(trim(whole.substr(0, whole.find('\0'))));
  return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
}

// Values below this one are missing heights. Terrain models store the lowest single-precision number where
// the height is unknown, and not all of these models have GDAL's tag.
constexpr float lowest_height = -1e38F;

// Inverts the values if 0 is white in this file, and replaces missing values by NaN.
void interpret(const Layout& layout, std::optional<float> missing, DepthImage& image) {
  const bool is_inverted = layout.colours == PHOTOMETRIC_MINISWHITE &&
                           layout.samples.kind == SampleKind::whole && layout.bits <= 32;
  const auto white = static_cast<float>(std::exp2(layout.bits) - 1);
  for (float& value : image.values.pixels) {
    if (value == missing || (std::isfinite(value) && value < lowest_height)) {
      value = std::numeric_limits<float>::quiet_NaN();
    } else if (is_inverted) {
      value = white - value;
    }
  }
}

}  // namespace

// Classic TIFF has version 42 and BigTIFF version 43, each in either byte order.
bool is_tiff(const Source& source) {
  using namespace std::string_view_literals;
  return std::ranges::any_of(std::array{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv},
                             [&](std::string_view mark) { return source.bytes.starts_with(mark); });
}

Result<DepthImage> read_depth_tiff(const Source& source, const PictureChannels& channels) {
  TiffBytes file(source.bytes);
  if (!file.handle()) return no_directory(source, file);
  choose_directory(file.handle());
  Layout layout = layout_of(file.handle());
  const std::size_t pixels = std::size_t{layout.width} * layout.height;
  if (pixels > most_pixels) return source.error({}, cat("expected at most 134217728 pixels, found ", pixels));
  RELIEVO_CHECK(check_packing(source, pixels, pixels));
  RELIEVO_CHECK(check_samples(source, layout, channels));
  const bool is_fraction = layout.samples.kind == SampleKind::fraction;
  DepthImage image{{}, is_fraction ? 0.0 : 1.0, "TIFF, " + std::to_string(layout.bits) + " bits"};
  const auto channel = static_cast<std::uint16_t>(std::max(channels.channel, 1) - 1);
  Broken broken = takes_luminance(layout, channels)
                      ? read_luminance(file.handle(), layout, image.values)
                      : read_channel(file.handle(), layout, channel, image.values);
  bool is_grey = true;
  if (!broken && must_be_grey(layout, channels))
    broken = compare_colours(file.handle(), layout, image.values, is_grey);
  if (broken) return broken_part(source, file, *broken);
  if (!is_grey) return several_channels(source, layout);
  interpret(layout, no_data(file.handle()), image);
  const bool has_alpha = layout.alpha && channels.channel != *layout.alpha + 1;
  if (has_alpha) broken = remove_transparent(file.handle(), layout, image.values);
  if (broken) return broken_part(source, file, *broken);
  image.pixel_size = geotiff_pixel_size(file.handle(), layout.height);
  turn_upright(image, layout.orientation);
  return image;
}

}  // namespace relievo::io
