#include "io/npy.h"

#include <algorithm>
#include <optional>

#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::string_view npy_mark = "\x93NUMPY";

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

// Returns the sizes in a text such as "160, 160", except those that are 1. Returns nothing if a part of the
// text is not a size.
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

// Returns the text of the header, which ends where the numbers begin.
Result<std::string_view> header_text(const Source& source) {
  const std::string_view bytes = source.bytes;
  const std::size_t length_at = npy_mark.size() + 2;
  const unsigned length_bytes = bytes.size() > npy_mark.size() && bytes[npy_mark.size()] == 1 ? 2 : 4;
  const std::size_t begin = length_at + length_bytes;
  const std::uint64_t length =
      begin <= bytes.size() ? whole_number(bytes.data() + length_at, length_bytes, false) : 0;
  if (begin > bytes.size() || length > bytes.size() - begin)
    return source.error_at_byte(length_at, "expected the header of an array, found the end of the file");
  return bytes.substr(begin, static_cast<std::size_t>(length));
}

std::unexpected<Error> other_type(const Source& source, std::string_view described) {
  if (described.starts_with('['))
    return source.error({},
                        "expected an array of numbers, found records; in Python "
                        "np.stack([a['x'], a['y'], a['z']], -1) is an array of points");
  return source.error(
      {}, cat("expected an array of numbers, found the type ", in_quotes(text_between(described, '\'', '\'')),
              "; in Python astype('float32') converts it"));
}

}  // namespace

bool NpyArray::has_points() const {
  constexpr std::size_t most_columns = 9, rows_per_column = 16;
  if (sizes.size() < 2) return false;
  const std::size_t columns = sizes.back();
  if (sizes.size() > 2) return columns == 3 && samples.kind != SampleKind::whole;
  const bool is_list = columns > 3 && columns <= most_columns && sizes[0] >= rows_per_column * columns;
  return columns == 3 || (is_list && samples.kind == SampleKind::fraction);
}

std::size_t NpyArray::place(std::size_t row, std::size_t column) const {
  if (!is_by_columns) return row * sizes.back() + column;
  std::size_t at = column;
  for (std::size_t i = sizes.size() - 1; i-- > 0; row /= sizes[i]) at = at * sizes[i] + row % sizes[i];
  return at;
}

bool has_npy_mark(const Source& source) {
  return source.bytes.starts_with(npy_mark);
}

Result<NpyArray> read_npy_header(const Source& source) {
  RELIEVO_TRY(const std::string_view text, header_text(source));
  NpyArray array;
  array.shape = text_between(text_behind(text, "shape"), '(', ')');
  array.is_by_columns = text_behind(text, "fortran_order").starts_with("True");
  array.data = static_cast<std::size_t>(text.data() + text.size() - source.bytes.data());
  const std::string_view described = text_behind(text, "descr"), type = text_between(described, '\'', '\'');
  const auto samples = sample_format_of(type);
  if (!samples) return other_type(source, described);
  const auto sizes = sizes_of(array.shape);
  if (!sizes || sizes->empty())
    return source.error({},
                        cat("expected an array with rows, found the shape (", printable(array.shape), ")"));
  array.samples = *samples;
  array.is_big_endian = type[0] == '>';
  array.sizes = *sizes;
  return array;
}

}  // namespace relievo::io
