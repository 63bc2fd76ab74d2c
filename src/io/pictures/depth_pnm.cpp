// Reads portable pictures: PFM (fractions) and PGM or PPM (integers of 8 or 16 bits, or text), grey or
// coloured.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "io/pictures/pictures.h"
#include "io/pictures/samples.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

struct PnmHeader {
  std::size_t width = 0, height = 0;
  double last = 0;  // PFM: its sign is the byte order; PGM, PPM: the largest value
  std::size_t data = 0;
};

// Reads the three numbers after the mark. A single character separates them from the data.
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

// The encoding of a picture's values in a file.
struct PnmValues {
  SampleFormat format;
  std::size_t channels = 1;
  bool is_big_endian = true, is_upside_down = false, is_text = false;

  std::size_t least_bytes() const { return channels * (is_text ? 1 : format.bits / 8); }
};

std::optional<PnmValues> values_of(std::string_view mark, double last) {
  const bool is_pfm = mark[1] == 'f' || mark[1] == 'F';
  const std::size_t channels = std::string_view("F63").contains(mark[1]) ? 3 : 1;
  if (is_pfm) return PnmValues{{SampleKind::fraction, 32}, channels, last > 0, true};
  if (!(last >= 1 && last <= 65535)) return std::nullopt;
  const bool is_text = mark[1] == '2' || mark[1] == '3';
  return PnmValues{{SampleKind::whole, last < 256 ? 8U : 16U}, channels, true, false, is_text};
}

// Sets the values from numbers of `bytes` bytes. `bytes` is a template argument, so that the compiled code is
// fast.
template <unsigned bytes>
Result<void> fill_from(const Source& source, const PnmHeader& header, const PictureChannels& wanted,
                       const PnmValues& stored, Image<float>& values) {
  const char* const data = source.bytes.data() + header.data;
  const auto pixel_colour = [=](std::size_t pixel) {
    PixelColour colour{};
    for (std::size_t c = 0; c < stored.channels; ++c) {
      const std::size_t number = pixel * stored.channels + c;
      colour[c] =
          decode_sample(stored.format, whole_number(data + bytes * number, bytes, stored.is_big_endian));
    }
    return colour;
  };
  if (!stored.is_upside_down) return fill_values(source, wanted, stored.channels, values, pixel_colour);
  const std::size_t width = header.width, last_row = header.height - 1;
  return fill_values(source, wanted, stored.channels, values,
                     [=](std::size_t i) { return pixel_colour((last_row - i / width) * width + i % width); });
}

Result<void> fill_from_bytes(const Source& source, const PnmHeader& header, const PictureChannels& wanted,
                             const PnmValues& stored, Image<float>& values) {
  const unsigned bytes = stored.format.bits / 8;
  const auto fill = bytes == 1 ? fill_from<1> : bytes == 2 ? fill_from<2> : fill_from<4>;
  return fill(source, header, wanted, stored, values);
}

// Returns the numbers of a text picture, which may have comments and line breaks anywhere.
Result<std::vector<float>> read_numbers(const Source& source, const PnmHeader& header, std::size_t wanted) {
  std::vector<float> numbers;
  numbers.reserve(wanted);
  Lines lines(source.bytes, header.data - 1);
  while (const auto line = lines.next()) {
    Words words(before_comment(*line));
    for (std::string_view word = words.next(); !word.empty() && numbers.size() < wanted;
         word = words.next()) {
      const auto number = parse_integer(word);
      if (!number || *number < 0 || static_cast<double>(*number) > header.last)
        return source.error_at_byte(
            static_cast<std::size_t>(word.data() - source.bytes.data()),
            cat("expected a number up to ", header.last, ", found ", in_quotes(word)));
      numbers.push_back(static_cast<float>(*number));
    }
  }
  if (numbers.size() == wanted) return numbers;
  return source.error(
      {}, cat("expected ", wanted, " numbers, found ", numbers.size(), "; the file is cut, get it anew"));
}

Result<void> fill_from_text(const Source& source, const PnmHeader& header, const PictureChannels& wanted,
                            std::size_t channels, Image<float>& values) {
  RELIEVO_TRY(const auto numbers, read_numbers(source, header, header.width * header.height * channels));
  return fill_values(source, wanted, channels, values, [&](std::size_t i) {
    PixelColour colour{};
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(channels * i), channels, colour.begin());
    return colour;
  });
}

// Returns whether the first line consists of the mark, and a number follows.
bool is_text_picture(std::string_view bytes) {
  if (bytes.size() < 3 || bytes[0] != 'P' || (bytes[1] != '2' && bytes[1] != '3')) return false;
  Lines lines(bytes);
  if (trim(before_comment(*lines.next())).size() != 2) return false;
  while (const auto line = lines.next()) {
    const std::string_view text = trim(before_comment(*line));
    if (!text.empty()) return text[0] >= '1' && text[0] <= '9';
  }
  return false;
}

}  // namespace

// Checks more than the mark, because a text file whose first column has names of points may begin with the
// same characters as a picture.
bool is_pnm(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (is_text_picture(bytes)) return true;
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
  RELIEVO_CHECK(check_room(source, {header.width, header.height, stored->least_bytes(), header.data}));
  const bool is_fraction = stored->format.kind == SampleKind::fraction;
  DepthImage image{
      {}, is_fraction ? 0. : 1., cat(is_fraction ? "PFM, " : "PNM, ", stored->format.bits, " bits")};
  image.values.resize(static_cast<int>(header.width), static_cast<int>(header.height));
  RELIEVO_CHECK(stored->is_text ? fill_from_text(source, header, wanted, stored->channels, image.values)
                                : fill_from_bytes(source, header, wanted, *stored, image.values));
  return image;
}

}  // namespace relievo::io
