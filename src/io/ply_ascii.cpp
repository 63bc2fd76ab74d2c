#include <algorithm>

#include "io/ply.h"

namespace relievo::io {
namespace {

// Each row begins on a new line, and may be wrapped over several lines.
class AsciiRows {
 public:
  AsciiRows(const Source& source, const PlyHeader& header)
      : lines_(source, header.data_offset, header.lines) {}

  // Calls use(property number, word) for each single value of the next row and use_item(property number,
  // word) for each value of its lists; they return false to refuse a word.
  template <typename Use, typename UseItem>
  Result<void> read_row(const PlyElement& element, Use&& use, UseItem&& use_item) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const std::string_view word = next_word();
      if (word.empty()) return fail_at_end(element);
      if (property.is_list()) {
        const auto use_word = [&](std::string_view item) { return use_item(i, item); };
        RELIEVO_CHECK(read_list(element, property, word, use_word));
      } else if (!use(i, word)) {
        return fail("expected a number for " + printable(property.name) + ", found " + in_quotes(word));
      }
    }
    const std::string_view word = words_.next();
    // MeshLab writes colours of a face's corners that its header does not declare. Therefore only vertex rows
    // with too many words are errors.
    if (!word.empty() && element.name == "vertex") return fail_in_long_row(element, word);
    words_ = Words();
    ++rows_;
    return {};
  }

  Result<void> skip(const PlyElement& element) {
    rows_ = 0;
    if (element.properties.empty()) return {};
    for (std::uint64_t row = 0; row < element.count; ++row) {
      const auto ignore = [](auto...) { return true; };
      RELIEVO_CHECK(read_row(element, ignore, ignore));
    }
    rows_ = 0;
    return {};
  }

  // Begins the rows of the next element.
  Result<void> begin(const PlyElement&) {
    rows_ = 0;
    return {};
  }

  // Appends the corners of the face in the next row.
  Result<void> read_face(const PlyElement& element, const FaceList& list,
                         std::vector<std::int64_t>& corners) {
    const auto ignore = [](auto...) { return true; };
    return read_row(element, ignore, [&](std::size_t property, std::string_view word) {
      const auto corner = parse_integer(word);
      if (property == list.property && corner) corners.push_back(*corner);
      return property != list.property || corner.has_value();
    });
  }

  // Returns an error at the line that was read last.
  Result<void> fail(std::string expected) const { return lines_.fail(std::move(expected)); }

 private:
  // Returns the next word, in this line or a later one; empty at the end of the file.
  std::string_view next_word() {
    std::string_view word = words_.next();
    while (word.empty()) {
      const auto line = lines_.next();
      if (!line) return {};
      words_ = Words(*line);
      word = words_.next();
    }
    return word;
  }

  template <typename UseItem>
  Result<void> read_list(const PlyElement& element, const PlyProperty& list, std::string_view word,
                         UseItem&& use_item) {
    const auto length = parse_integer(word);
    if (!length || *length < 0) {
      return fail("expected the length of the list " + printable(list.name) + ", found " + in_quotes(word));
    }
    for (std::int64_t i = 0; i < *length; ++i) {
      const std::string_view item = next_word();
      if (item.empty()) return fail_at_end(element);
      if (!use_item(item)) return fail_in_list(list, item);
    }
    return {};
  }

  Result<void> fail_at_end(const PlyElement& element) const {
    return fail(cat("expected ", element.count, " rows of element ", printable(element.name),
                    ", found the end of the file after ", rows_));
  }

  Result<void> fail_in_long_row(const PlyElement& element, std::string_view word) const {
    return fail("expected the line to end after the last property, " +
                printable(element.properties.back().name) + ", found " + in_quotes(word));
  }

  Result<void> fail_in_list(const PlyProperty& list, std::string_view word) const {
    return fail("expected whole numbers in the list " + printable(list.name) + ", found " + in_quotes(word));
  }

  SourceLines lines_;
  Words words_;
  std::uint64_t rows_ = 0;  // the complete rows of the element being read
};

// Each value takes at least two bytes, a digit and a separator; only the last one of the file needs no
// separator.
bool can_hold(std::size_t bytes, const PlyElement& element) {
  return element.count <= (bytes + 1) / (2 * element.properties.size());
}

// Allocates no memory if the header promises more vertices than the bytes can contain; reading then ends with
// an error.
Result<void> read_vertices(const PlyBody& body, AsciiRows& rows, Cloud& cloud) {
  const std::size_t left = body.source.bytes.size() - body.header.data_offset;
  cloud = sized_cloud(can_hold(left, body.vertex) ? body.vertex.count : 0, body.columns);
  std::vector<std::size_t> column_of(body.vertex.properties.size(), VertexColumns::most);
  for (std::size_t c = 0; c < VertexColumns::most; ++c)
    if (body.columns.is_there[c]) column_of[body.columns.property[c]] = c;
  const double scale =
      body.columns.has_colours() ? colour_scale(body.vertex.properties[body.columns.property[6]].type) : 1;
  std::array<double, VertexColumns::most> values = {};
  const auto take = [&](std::size_t property, std::string_view word) {
    if (column_of[property] == VertexColumns::most) return true;  // not read: it may be a text, such as True
    const auto value = parse_number(word);
    if (value) values[column_of[property]] = *value;
    return value.has_value();
  };
  const auto byte = [&](double v) {
    return v > 0 ? static_cast<std::uint8_t>(std::min(255.0, scale * v + .5)) : std::uint8_t{0};
  };
  for (std::size_t i = 0; i < body.vertex.count; ++i) {
    if (const auto read = rows.read_row(body.vertex, take, [](auto...) { return true; }); !read) return read;
    if (i >= cloud.size()) continue;
    cloud.points[i] = Vec3(values[0], values[1], values[2]);
    if (cloud.has_normals()) cloud.normals[i] = unit_normal(Vec3(values[3], values[4], values[5]));
    if (cloud.has_colours()) cloud.colours[i] = {byte(values[6]), byte(values[7]), byte(values[8])};
  }
  return {};
}

}  // namespace

Result<PlyContent> read_ascii_body(const PlyBody& body) {
  return read_elements(body, AsciiRows(body.source, body.header));
}

}  // namespace relievo::io
