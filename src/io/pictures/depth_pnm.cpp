// Reads portable pictures in binary: PFM (fractions) and PGM or PPM (whole numbers of 8 or 16 bits), grey or
// in colours.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/pictures/pictures.h"
#include "io/pictures/samples.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

struct PnmHeader {
  std::size_t width = 0, height = 0;
  double last = 0;  // PFM: its sign is the byte order; PGM and PPM: the largest value
  std::size_t data = 0;
};

// Reads the three numbers after the mark. One character separates them from the data.
Result<PnmHeader> read_pnm_header(const Source& source) {
  const std::string_view bytes = source.bytes;
  std::array<double, 3> numbers{};
  std::size_t at = 2;
  const auto is_white = [&](std::size_t i) {
    return is_blank(bytes[i]) || bytes[i] == '\n' || bytes[i] == '\r';
  };
  for (double& number : numbers) {
    while (at < bytes.size() && (is_white(at) || bytes[at] == '#')) {
      const bool is_comment = bytes[at] == '#';
      at = is_comment ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
    }
    const std::size_t begin = at;
    while (at < bytes.size() && !is_white(at)) ++at;
    const auto value = parse_number(bytes.substr(begin, at - begin));
    if (!value || !std::isfinite(*value))
      return source.error_at_byte(begin, cat("expected width, height and range of the picture, found ",
                                             in_quotes(bytes.substr(begin, at - begin))));
    number = *value;
  }
  const auto is_size = [](double n) { return n >= 1 && n <= 1e9 && n == std::floor(n); };
  if (!is_size(numbers[0]) || !is_size(numbers[1]))
    return source.error_at_byte(2, cat("expected width and height, found ", numbers[0], " and ", numbers[1]));
  return PnmHeader{static_cast<std::size_t>(numbers[0]), static_cast<std::size_t>(numbers[1]), numbers[2],
                   at + 1};
}

// The format in which a file stores the values of a picture.
struct PnmValues {
  SampleFormat format;
  std::size_t channels = 1;
  bool is_big_endian = true, is_upside_down = false;
};

std::optional<PnmValues> values_of(std::string_view mark, double last) {
  const bool is_pfm = mark[1] == 'f' || mark[1] == 'F';
  const std::size_t channels = mark[1] == 'F' || mark[1] == '6' ? 3 : 1;
  if (is_pfm) return PnmValues{{SampleKind::fraction, 32}, channels, last > 0, true};
  if (!(last >= 1 && last <= 65535)) return std::nullopt;
  return PnmValues{{SampleKind::whole, last < 256 ? 8U : 16U}, channels};
}

}  // namespace

// Text with the name of a point in its first column may begin with the mark, too.
bool is_pnm(const Source& source) {
  const std::string_view bytes = source.bytes;
  const auto is_binary = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  const std::size_t enough = 4096;
  if (!has_control_bytes(bytes) && !std::ranges::any_of(bytes.substr(0, enough), is_binary)) return false;
  if (bytes.size() < 3 || bytes[0] != 'P' || !std::string_view("fF56").contains(bytes[1])) return false;
  return is_blank(bytes[2]) || bytes[2] == '\n' || bytes[2] == '\r';
}

Result<DepthImage> read_depth_pnm(const Source& source, const PictureChannels& wanted) {
  RELIEVO_TRY(const PnmHeader header, read_pnm_header(source));
  const auto stored = values_of(source.bytes, header.last);
  if (!stored) return source.error({}, cat("expected a largest value from 1 to 65535, found ", header.last));
  const unsigned bytes = stored->format.bits / 8;
  RELIEVO_CHECK(check_room(source, {header.width, header.height, bytes * stored->channels, header.data}));
  const bool is_fraction = stored->format.kind == SampleKind::fraction;
  DepthImage image{
      {}, is_fraction ? 0. : 1., cat(is_fraction ? "PFM, " : "PNM, ", stored->format.bits, " bits")};
  image.values.resize(static_cast<int>(header.width), static_cast<int>(header.height));
  const char* data = source.bytes.data() + header.data;
  RELIEVO_CHECK(fill_values(source, wanted, stored->channels, image.values, [&](std::size_t i) {
    const std::size_t row = i / header.width, from = stored->is_upside_down ? header.height - 1 - row : row,
                      first = (from * header.width + i % header.width) * stored->channels;
    PixelColour colour{};
    for (std::size_t c = 0; c < stored->channels; ++c)
      colour[c] = decode_sample(stored->format,
                                whole_number(data + bytes * (first + c), bytes, stored->is_big_endian));
    return colour;
  }));
  return image;
}

}  // namespace relievo::io
