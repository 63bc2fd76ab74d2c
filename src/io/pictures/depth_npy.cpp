// Reads arrays saved by NumPy (NPY, versions 1 to 3). Only two-dimensional arrays of numbers are pictures;
// dimensions of length 1 are ignored.
#include <algorithm>
#include <optional>
#include <vector>

#include "io/pictures/pictures.h"
#include "io/pictures/samples.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::string_view npy_mark = "\x93NUMPY";

struct NpyHeader {
  std::string_view type, shape;  // as written in the file: "<f4", "160, 160"
  bool is_by_columns = false, is_big_endian = false;
  SampleFormat samples = {};
  std::vector<std::size_t> sizes;  // lengths of the dimensions, except those of length 1
  std::size_t data = 0;            // offset of the first number
};

// Returns the text after "'key':" and blanks.
std::string_view text_behind(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(cat("'", key, "':"));
  if (at == std::string_view::npos) return {};
  header.remove_prefix(at + key.size() + 3);
  return trim(header);
}

// Returns the text between `open`, which must be the first character, and the next `close`.
std::string_view text_between(std::string_view text, char open, char close) {
  if (!text.starts_with(open)) return {};
  const std::size_t end = text.find(close, 1);
  return end == std::string_view::npos ? std::string_view() : text.substr(1, end - 1);
}

// Returns the format of a type such as "<f4": byte order, kind of number, number of bytes.
std::optional<SampleFormat> sample_format_of(std::string_view type) {
  if (type.size() != 3 || !std::string_view("<>=|").contains(type[0])) return std::nullopt;
  const unsigned bits = 8 * static_cast<unsigned>(type[2] - '0');
  const bool is_whole = bits == 8 || bits == 16 || bits == 32 || bits == 64;
  if (type[1] == 'f' && is_whole && bits > 8) return SampleFormat{SampleKind::fraction, bits};
  if (type[1] == 'i' && is_whole) return SampleFormat{SampleKind::signed_whole, bits};
  if ((type[1] == 'u' && is_whole) || type.substr(1) == "b1") return SampleFormat{SampleKind::whole, bits};
  return std::nullopt;
}

// Returns the numbers in a text such as "160, 160" except 1; nothing if the text contains anything else.
std::optional<std::vector<std::size_t>> sizes_of(std::string_view shape) {
  std::vector<std::size_t> sizes;
  while (!trim(shape).empty()) {
    const std::size_t end = std::min(shape.find(','), shape.size());
    const auto size = parse_integer(trim(shape.substr(0, end)));
    if (!size || *size < 0) return std::nullopt;
    if (*size != 1) sizes.push_back(static_cast<std::size_t>(*size));
    shape.remove_prefix(std::min(end + 1, shape.size()));
  }
  return sizes;
}

Result<NpyHeader> read_npy_header(const Source& source) {
  const std::string_view bytes = source.bytes;
  const std::size_t length_at = npy_mark.size() + 2;
  const unsigned length_bytes = bytes.size() > npy_mark.size() && bytes[npy_mark.size()] == 1 ? 2 : 4;
  const std::size_t begin = length_at + length_bytes;
  const std::uint64_t length =
      begin <= bytes.size() ? whole_number(bytes.data() + length_at, length_bytes, false) : 0;
  if (begin > bytes.size() || length > bytes.size() - begin)
    return source.error_at_byte(length_at, "expected the header of an array, found the end of the file");
  const std::string_view text = bytes.substr(begin, static_cast<std::size_t>(length));
  NpyHeader header;
  header.type = text_between(text_behind(text, "descr"), '\'', '\'');
  header.shape = text_between(text_behind(text, "shape"), '(', ')');
  header.is_by_columns = text_behind(text, "fortran_order").starts_with("True");
  header.data = begin + static_cast<std::size_t>(length);
  return header;
}

// Interprets the texts of the header. Returns an error that explains why the array is not a picture.
Result<void> interpret_header(const Source& source, NpyHeader& header) {
  const auto samples = sample_format_of(header.type);
  if (!samples)
    return source.error({}, cat("expected an array of numbers, found the type ", in_quotes(header.type),
                                "; in Python astype('float32') converts it"));
  const auto sizes = sizes_of(header.shape);
  if (!sizes || sizes->size() != 2)
    return source.error({}, cat("expected an array of rows and columns, found the shape (",
                                printable(header.shape), "); in Python a[..., 0] is one of its channels"));
  header.samples = *samples;
  header.is_big_endian = header.type[0] == '>';
  header.sizes = *sizes;
  return {};
}

}  // namespace

bool is_npy(const Source& source) {
  return source.bytes.starts_with(npy_mark);
}

Result<DepthImage> read_depth_npy(const Source& source, const PictureChannels&) {
  RELIEVO_TRY(NpyHeader header, read_npy_header(source));
  RELIEVO_CHECK(interpret_header(source, header));
  const std::size_t rows = header.sizes[0], columns = header.sizes[1];
  const unsigned bytes = header.samples.bits / 8;
  RELIEVO_CHECK(check_room(source, {columns, rows, bytes, header.data}));
  const bool is_fraction = header.samples.kind == SampleKind::fraction;
  DepthImage image{{}, is_fraction ? 0.0 : 1.0, cat("NPY, ", header.samples.bits, " bits")};
  image.values.resize(static_cast<int>(columns), static_cast<int>(rows));
  const std::size_t in_row = header.is_by_columns ? rows : 1, in_column = header.is_by_columns ? 1 : columns;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const char* from = source.bytes.data() + header.data + bytes * (r * in_column + c * in_row);
      image.values[r * columns + c] =
          decode_sample(header.samples, whole_number(from, bytes, header.is_big_endian));
    }
  return image;
}

}  // namespace relievo::io
