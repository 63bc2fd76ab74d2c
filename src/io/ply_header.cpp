#include "io/ply.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/text.h"

namespace relievo::io {
namespace {

// The names of the number types, two for each type, in the order of NumberType.
constexpr std::array<std::string_view, 16> type_names = {
    "char", "int8",  "uchar", "uint8",  "short", "int16",   "ushort", "uint16",
    "int",  "int32", "uint",  "uint32", "float", "float32", "double", "float64"};
constexpr std::array<std::string_view, 3> format_names = {"ascii", "binary_little_endian",
                                                          "binary_big_endian"};

std::optional<NumberType> type_named(std::string_view name) {
  if (name == "bool") return NumberType::uint8;
  const auto found = std::ranges::find(type_names, name) - type_names.begin();
  if (found == std::ssize(type_names)) return std::nullopt;
  return static_cast<NumberType>(found / 2);
}

// Reads the header in one pass over the lines. Each function gets the words after the line's keyword.
class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(const Source& source) : lines_(source) {}

  Result<PlyHeader> read() {
    lines_.next();  // skips "ply", which the caller has checked
    while (const auto line = lines_.next()) {
      Words words(*line);
      const std::string_view keyword = words.next();
      if (keyword == "end_header") return finish();
      RELIEVO_CHECK(take(keyword, words));
    }
    return lines_.fail_at_end("end_header");
  }

 private:
  Result<void> take(std::string_view keyword, Words& words) {
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) return {};
    if (keyword == "format") return take_format(words);
    if (keyword == "element") return take_element(words);
    if (keyword == "property") return take_property(words);
    // Old versions of Blender wrote a comment without the keyword "comment".
    if (header_.elements.empty()) return {};
    return lines_.fail("expected format, element, property, comment, obj_info or end_header, found " +
                       in_quotes(keyword));
  }

  Result<void> take_format(Words& words) {
    const std::string_view name = words.next();
    const auto format = std::ranges::find(format_names, name);
    if (format == format_names.end())
      return lines_.fail("expected ascii, binary_little_endian or binary_big_endian, found " +
                         in_quotes(name));
    const std::string_view version = words.next();
    if (version != "1.0") return lines_.fail("expected version 1.0 of PLY, found " + in_quotes(version));
    if (std::exchange(has_format_, true)) return lines_.fail("expected one format line, found a second");
    header_.format = static_cast<PlyFormat>(format - format_names.begin());
    return {};
  }

  Result<void> take_element(Words& words) {
    const std::string_view name = words.next();
    if (name.empty()) return lines_.fail("expected 'element <name> <count>', found no name");
    const std::string_view word = words.next();
    const auto count = parse_integer(word);
    if (!count || *count < 0) return lines_.fail("expected the number of elements, found " + in_quotes(word));
    header_.elements.push_back({name, static_cast<std::uint64_t>(*count), {}, lines_.number()});
    return {};
  }

  Result<void> take_property(Words& words) {
    if (header_.elements.empty())
      return lines_.fail("expected an element before its first property, found none");
    std::string_view word = words.next();
    std::optional<NumberType> count_type;
    if (word == "list") {
      word = words.next();
      count_type = type_named(word);
      if (!count_type || *count_type >= NumberType::float32)
        return lines_.fail("expected an integer type for the length of the list, found " + in_quotes(word));
      word = words.next();
    }
    const auto type = type_named(word);
    if (!type) return lines_.fail("expected a type such as float, uchar or int32, found " + in_quotes(word));
    const std::string_view name = words.next();
    if (name.empty()) return lines_.fail("expected the name of the property, found the end of the line");
    header_.elements.back().properties.push_back({name, *type, count_type});
    return {};
  }

  Result<PlyHeader> finish() {
    if (!has_format_) return lines_.fail("expected a line 'format ...' before end_header, found none");
    header_.lines = lines_.number();
    header_.data_offset = lines_.offset();
    // If lines end with CR alone, an LF after the header's last CR already belongs to the data.
    const std::string_view bytes = lines_.source().bytes;
    const std::size_t first_end = bytes.find_first_of("\r\n");
    const bool ends_with_cr_alone = bytes.substr(first_end, 2) != "\r\n" && bytes[first_end] == '\r';
    const bool has_skipped_lf = bytes.substr(header_.data_offset - 2, 2) == "\r\n";
    if (ends_with_cr_alone && has_skipped_lf) --header_.data_offset;
    return std::move(header_);
  }

  SourceLines lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

std::size_t least_row_size(const PlyElement& element) {
  std::size_t size = 0;
  for (const PlyProperty& p : element.properties) size += size_in_bytes(p.count_type.value_or(p.type));
  return size;
}

bool has_lists(const PlyElement& element) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [](const PlyProperty& p) { return p.is_list(); });
}

Result<PlyHeader> read_ply_header(const Source& source) {
  return PlyHeaderReader(source).read();
}

}  // namespace relievo::io
