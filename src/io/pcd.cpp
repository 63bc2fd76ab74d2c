// Reads PCD 0.7 and earlier versions: ascii, binary, and binary_compressed (LZF, field by field).
#include <lzf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "io/formats.h"
#include "io/numbers.h"
#include "io/readers.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

enum class PcdData { ascii, binary, compressed };

struct PcdHeader {
  PcdData data = PcdData::ascii;
  Records records;                       // layout of the points; ascii files use only `count`
  std::vector<std::size_t> field_sizes;  // bytes of each field of a point
  std::size_t lines = 0;                 // number of lines of the header
  std::size_t columns_of_picture = 0;    // columns of an organised cloud, else 0
  // For ascii rows: the number of words, and the indices of the words to read.
  std::size_t columns = 0;
  std::array<std::size_t, 3> position_columns = {}, normal_columns = {};
  std::size_t colour_column = 0;
  bool is_colour_float = false;  // whether the bits of the float are the colour, instead of its value
};

struct Field {
  std::string_view name;
  std::size_t size = 4, count = 1;  // bytes per value; values per point
  char type = 'F';
  std::size_t at = 0;      // byte offset within a row
  std::size_t column = 0;  // index of the field's first value within a row
};

class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(const Source& source) : lines_(source) {}

  Result<PcdHeader> read() {
    while (const auto line = lines_.next()) {
      Words words(*line);
      const std::string_view keyword = words.next();
      if (keyword.empty() || keyword.starts_with('#')) continue;
      RELIEVO_CHECK(take(keyword, words));
      if (keyword == "DATA") return finish();
    }
    return lines_.fail_at_end("a line DATA");
  }

 private:
  Result<void> take(std::string_view keyword, Words& words) {
    if (keyword == "VERSION" || keyword == "VIEWPOINT") return {};
    if (keyword == "FIELDS" || keyword == "COLUMNS") return take_fields(words);
    if (keyword == "SIZE")
      return take_numbers(words, [](Field& f, std::int64_t n) {
        f.size = static_cast<std::size_t>(n);
        return n == 1 || n == 2 || n == 4 || n == 8;
      });
    if (keyword == "COUNT")
      return take_numbers(words, [](Field& f, std::int64_t n) {
        f.count = static_cast<std::size_t>(n);
        return n >= 1 && n <= 65536;
      });
    if (keyword == "TYPE") return take_types(words);
    if (keyword == "WIDTH") return take_count(words, width_);
    if (keyword == "HEIGHT") return take_count(words, height_);
    if (keyword == "POINTS") return take_count(words, points_);
    if (keyword == "DATA") return take_data(words.next());
    // Some programs add lines of their own. These are ignored if their keywords consist of capitals.
    const auto is_capital = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    if (std::ranges::all_of(keyword, is_capital)) return {};
    return lines_.fail("expected FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, POINTS or DATA, found " +
                       in_quotes(keyword));
  }

  Result<void> take_fields(Words& words) {
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) fields_.push_back({word});
    return fields_.empty() ? lines_.fail("expected the names of the fields, found none") : Result<void>{};
  }

  template <typename Set>
  Result<void> take_numbers(Words& words, Set&& set) {
    for (Field& field : fields_) {
      const std::string_view word = words.next();
      const auto number = parse_integer(word);
      if (!number || !set(field, *number))
        return lines_.fail("expected a size of 1, 2, 4 or 8 or a count for field " + printable(field.name) +
                           ", found " + in_quotes(word));
    }
    return {};
  }

  Result<void> take_types(Words& words) {
    for (Field& field : fields_) {
      const std::string_view word = words.next();
      if (word != "F" && word != "I" && word != "U")
        return lines_.fail("expected type F, I or U for field " + printable(field.name) + ", found " +
                           in_quotes(word));
      field.type = word[0];
    }
    return {};
  }

  Result<void> take_count(Words& words, std::int64_t& to) {
    const std::string_view word = words.next();
    const auto number = parse_integer(word);
    if (!number || *number < 0 || *number >= std::int64_t{no_index})
      return lines_.fail("expected a number of points, found " + in_quotes(word));
    to = *number;
    return {};
  }

  Result<void> take_data(std::string_view word) {
    constexpr std::array<std::string_view, 3> names = {"ascii", "binary", "binary_compressed"};
    const auto found = std::ranges::find(names, word);
    if (found == names.end())
      return lines_.fail("expected ascii, binary or binary_compressed, found " + in_quotes(word));
    header_.data = static_cast<PcdData>(found - names.begin());
    return {};
  }

  Result<PcdHeader> finish() {
    // Divides instead of multiplying, because the product of width and height could overflow.
    const bool fits = height_ == 0 || width_ <= std::int64_t{no_index} / height_;
    if (points_ < 0 && fits) points_ = width_ * height_;
    if (points_ < 0 || points_ >= std::int64_t{no_index})
      return lines_.fail(cat("expected the number of points before DATA, up to 4294967294, found ",
                             points_ >= 0  ? std::to_string(points_)
                             : width_ >= 0 ? cat("WIDTH ", width_, " and HEIGHT ", height_)
                                           : "none"));
    Records& records = header_.records;
    records.count = static_cast<std::uint64_t>(points_);
    if (height_ > 1 && fits && points_ == width_ * height_)
      header_.columns_of_picture = static_cast<std::size_t>(width_);
    records.offset = lines_.offset();
    header_.lines = lines_.number();
    for (Field& f : fields_) {
      f.at = records.stride, f.column = header_.columns;
      records.stride += f.size * f.count;
      header_.columns += f.count;
      header_.field_sizes.push_back(f.size * f.count);
    }
    const std::size_t widest = 1 << 20;
    if (records.stride > widest)
      return lines_.fail(cat("expected at most 1048576 bytes per point, found ", records.stride));
    RELIEVO_CHECK(place_columns());
    return std::move(header_);
  }

  const Field* find(std::string_view name) const {
    const auto found =
        std::ranges::find_if(fields_, [&](const Field& f) { return equals_ignoring_case(f.name, name); });
    return found == fields_.end() ? nullptr : &*found;
  }

  std::string names() const {
    std::string all;
    for (const Field& field : fields_) {
      if (all.size() > 60) return all + ", ...";
      all +=
          (all.empty() ? "" : ", ") + printable(field.name) + ' ' + field.type + std::to_string(field.size);
    }
    return all.empty() ? "none" : all;
  }

  // Returns the type of a field's numbers; nothing for unsupported types, such as 64-bit integers.
  static std::optional<NumberType> type_of(const Field& f) {
    using enum NumberType;
    if (f.type == 'F')
      return f.size == 4 ? std::optional(float32) : f.size == 8 ? std::optional(float64) : std::nullopt;
    if (f.size == 8) return std::nullopt;
    const bool is_signed = f.type == 'I';
    if (f.size == 1) return is_signed ? int8 : uint8;
    if (f.size == 2) return is_signed ? int16 : uint16;
    return is_signed ? int32 : uint32;
  }

  // Stores the columns of three fields. Returns false unless all three exist.
  bool place(const std::array<std::string_view, 3>& names, std::array<RecordColumn, 3>& to,
             std::array<std::size_t, 3>& ascii) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Field* field = find(names[i]);
      const auto type = field ? type_of(*field) : std::nullopt;
      if (!type) return false;
      to[i] = {*type, field->at};
      ascii[i] = field->column;
    }
    return true;
  }

  Result<void> place_columns() {
    Records& records = header_.records;
    if (!place({"x", "y", "z"}, records.position, header_.position_columns))
      return lines_.fail("expected fields x, y and z of a numeric type, found " + names());
    std::array<RecordColumn, 3> columns;
    std::array<std::size_t, 3> ascii;
    if (place({"normal_x", "normal_y", "normal_z"}, columns, ascii) ||
        place({"nx", "ny", "nz"}, columns, ascii)) {
      records.normal = columns;
      header_.normal_columns = ascii;
    }
    const Field* colour = find("rgb") ? find("rgb") : find("rgba");
    if (!colour || colour->size != 4) return {};
    // A colour is a 32-bit number, 0x00RRGGBB, even if its type is float.
    using enum NumberType;
    records.colour = {{{uint8, colour->at + 2}, {uint8, colour->at + 1}, {uint8, colour->at}}};
    header_.colour_column = colour->column;
    header_.is_colour_float = colour->type == 'F';
    return {};
  }

  SourceLines lines_;
  std::vector<Field> fields_;
  std::int64_t width_ = -1, height_ = 1, points_ = -1;
  PcdHeader header_;
};

Result<Cloud> read_ascii(const Source& source, const PcdHeader& header) {
  SourceLines lines(source, header.records.offset, header.lines);
  Cloud cloud;
  std::vector<double> values(header.columns);
  std::string spaced;  // a line after replacing commas, which some programs write between numbers
  const auto vector = [&](const std::array<std::size_t, 3>& c) {
    return Vec3(values[c[0]], values[c[1]], values[c[2]]);
  };
  while (cloud.size() < header.records.count) {
    const auto line = lines.next();
    if (!line) return lines.fail_at_end(cat(header.records.count, " points"), cat(" after ", cloud.size()));
    if (trim(*line).empty()) continue;
    if (line->contains(',')) {
      spaced = *line;
      std::ranges::replace(spaced, ',', ' ');
    }
    Words words(line->contains(',') ? std::string_view(spaced) : *line);
    for (double& value : values) {
      const std::string_view word = words.next();
      const auto number = parse_number(word);
      if (!number) return lines.fail(cat("expected ", values.size(), " numbers, found ", in_quotes(word)));
      value = *number;
    }
    cloud.points.push_back(vector(header.position_columns));
    if (header.records.normal) cloud.normals.push_back(unit_normal(vector(header.normal_columns)));
    if (!header.records.colour) continue;
    const double packed = values[header.colour_column];
    const bool is_whole = packed >= 0 && packed < 4294967296.0;
    std::uint32_t bits = is_whole ? static_cast<std::uint32_t>(packed) : 0;
    if (header.is_colour_float) {
      const auto as_float = static_cast<float>(packed);
      std::memcpy(&bits, &as_float, sizeof bits);
    }
    cloud.colours.push_back({static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 8),
                             static_cast<std::uint8_t>(bits)});
  }
  return cloud;
}

// Decompresses `in` to fill `out`. Returns false if the sizes do not match. Handles empty input, which the
// library refuses.
bool unpack_lzf(std::string_view in, std::vector<char>& out) {
  if (in.empty() || out.empty()) return in.size() == out.size();
  const auto in_size = static_cast<unsigned>(in.size()), out_size = static_cast<unsigned>(out.size());
  return lzf_decompress(in.data(), in_size, out.data(), out_size) == out_size;
}

Result<Cloud> read_compressed(const Source& source, const PcdHeader& header) {
  const Records& records = header.records;
  const std::string_view data = source.bytes.substr(records.offset);
  if (data.size() < 8)
    return source.error_at_byte(records.offset,
                                "expected the sizes of the compressed points, found the end of the file");
  const std::size_t packed = little<std::uint32_t>(data.data()),
                    size = little<std::uint32_t>(data.data() + 4);
  if (packed > data.size() - 8)
    return source.error_at_byte(records.offset,
                                cat("expected ", packed, " compressed bytes, found ", data.size() - 8));
  const std::size_t most_growth = 264;  // a byte of LZF yields at most this many bytes
  if (size != records.count * records.stride || size / most_growth > packed)
    return source.error_at_byte(records.offset + 4, cat("expected ", records.count * records.stride,
                                                        " bytes of points, found ", size));
  std::vector<char> fields(size), rows(size);
  if (!unpack_lzf(data.substr(8, packed), fields))
    return source.error_at_byte(records.offset + 8, cat("expected LZF-compressed points of ", size,
                                                        " bytes, found bytes that do not unpack to as many"));
  std::size_t from = 0, at = 0;
  for (const std::size_t width : header.field_sizes) {
    for (std::size_t i = 0; i < records.count; ++i, from += width)
      std::memcpy(rows.data() + i * records.stride + at, fields.data() + from, width);
    at += width;
  }
  return decode_all(records, rows.data());
}

Result<Cloud> read_binary(const Source& source, const PcdHeader& header) {
  const Records& records = header.records;
  const std::size_t room = (source.bytes.size() - records.offset) / records.stride;
  if (records.count > room)
    return source.error_at_byte(records.offset, cat("expected ", records.count, " points of ", records.stride,
                                                    " bytes, found room for ", room));
  return decode_all(records, source.bytes.data() + records.offset);
}

}  // namespace

bool is_pcd(const Source& source) {
  if (has_ending(source.name, ".pcd")) return true;
  const std::string_view text = source.bytes.substr(byte_order_mark_size(source.bytes));
  return text.starts_with("# .PCD") || text.starts_with("VERSION 0.7") || text.starts_with("VERSION .7");
}

Result<StreamRecords> find_pcd_rows(const Source& head) {
  RELIEVO_TRY(const auto header, PcdHeaderReader(head).read());
  if (header.data != PcdData::binary)
    return head.error({}, "expected binary points, to be read piece by piece");
  return StreamRecords{header.records, "PCD binary"};
}

Result<RawCloud> read_pcd(const Source& source) {
  RELIEVO_TRY(const auto header, PcdHeaderReader(source).read());
  constexpr std::array readers = {read_ascii, read_binary, read_compressed};
  constexpr std::array<std::string_view, 3> names = {"PCD ascii", "PCD binary", "PCD binary compressed"};
  const auto kind = static_cast<std::size_t>(header.data);
  RELIEVO_TRY(auto cloud, readers[kind](source, header));
  return RawCloud{
      .cloud = std::move(cloud), .format = std::string(names[kind]), .columns = header.columns_of_picture};
}

}  // namespace relievo::io
