#include <algorithm>
#include <utility>
#include <vector>

#include "io/ply.h"
#include "io/text.h"

namespace relievo::io {
namespace {

// Each row begins on a new line, and may be wrapped over several lines.
class AsciiRows {
 public:
  AsciiRows(const Source& source, const PlyHeader& header)
      : source_(source), lines_(source.bytes, header.data_offset, header.lines) {}

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
        if (const auto read = read_list(element, property, word, use_word); !read) return read;
      } else if (!use(i, word)) {
        return fail("expected a number for " + printable(property.name) + ", found " + in_quotes(word));
      }
    }
    const std::string_view word = words_.next();
    // MeshLab writes colours of a face's corners, which its header does not declare. Only vertices must be
    // right.
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
      if (const auto read = read_row(element, ignore, ignore); !read) return read;
    }
    rows_ = 0;
    return {};
  }

  // Begins the rows of the next element.
  void begin_element() { rows_ = 0; }

  // Returns an error at the line that was read last.
  Result<void> fail(std::string expected) const {
    return source_.error_in_line(lines_.number(), std::move(expected));
  }

 private:
  // Returns the next word, on this line or a later one; empty at the end of the file.
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
    return fail("expected " + std::to_string(element.count) + " rows of element " + printable(element.name) +
                ", found the end of the file after " + std::to_string(rows_));
  }

  Result<void> fail_in_long_row(const PlyElement& element, std::string_view word) const {
    return fail("expected the line to end after the last property, " +
                printable(element.properties.back().name) + ", found " + in_quotes(word));
  }

  Result<void> fail_in_list(const PlyProperty& list, std::string_view word) const {
    return fail("expected whole numbers in the list " + printable(list.name) + ", found " + in_quotes(word));
  }

  const Source& source_;
  Lines lines_;
  Words words_;
  std::uint64_t rows_ = 0;  // the complete rows of the element being read
};

// Each value takes at least two bytes, a digit and a separator; only the last one of the file needs no
// separator.
bool can_hold(std::size_t bytes, const PlyElement& element) {
  return element.count <= (bytes + 1) / (2 * element.properties.size());
}

Result<void> read_vertices(const PlyBody& body, AsciiRows& rows, Cloud& cloud) {
  std::vector<std::size_t> column_of(body.vertex.properties.size(), VertexColumns::most);
  for (std::size_t c = 0; c < VertexColumns::most; ++c)
    if (body.columns.is_there[c]) column_of[body.columns.property[c]] = c;
  const double scale =
      body.columns.has_colours() ? colour_scale(body.vertex.properties[body.columns.property[6]].type) : 1;
  std::array<double, VertexColumns::most> values = {};
  const auto take = [&](std::size_t property, std::string_view word) {
    if (column_of[property] == VertexColumns::most) return true;  // it may be a text, such as True
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

Result<void> read_faces(const PlyElement& element, const FaceList& list, AsciiRows& rows,
                        PlyContent& content) {
  std::vector<std::int64_t> corners;
  rows.begin_element();
  const auto take = [&](std::size_t property, std::string_view word) {
    const auto corner = parse_integer(word);
    if (property == list.property && corner) corners.push_back(*corner);
    return property != list.property || corner.has_value();
  };
  for (std::uint64_t row = 0; row < element.count; ++row) {
    corners.clear();
    if (const auto read = rows.read_row(
            element, [](auto...) { return true; }, take);
        !read)
      return read;
    if (!add_face(corners, list.kind, content.cloud.points, content.triangles))
      return rows.fail(expected_corners(corners, content.cloud.points) + " in row " + std::to_string(row) +
                       " of element " + printable(element.name));
  }
  return {};
}

}  // namespace

Result<PlyContent> read_ascii_body(const PlyBody& body) {
  AsciiRows rows(body.source, body.header);
  std::vector<std::pair<const PlyElement*, AsciiRows>> early_faces;
  for (const PlyElement& element : body.before) {
    if (find_face_list(element)) early_faces.emplace_back(&element, rows);
    RELIEVO_CHECK(rows.skip(element));
  }
  const std::size_t left = body.source.bytes.size() - body.header.data_offset;
  // If the header promises more vertices than the bytes can contain, an error follows below; this saves the
  // memory.
  PlyContent content{sized_cloud(can_hold(left, body.vertex) ? body.vertex.count : 0, body.columns), {}};
  RELIEVO_CHECK(read_vertices(body, rows, content.cloud));
  for (auto& [element, at] : early_faces)
    RELIEVO_CHECK(read_faces(*element, *find_face_list(*element), at, content));
  for (const PlyElement& element : body.after) {
    const auto list = find_face_list(element);
    const auto read = list ? read_faces(element, *list, rows, content) : rows.skip(element);
    if (!read) return std::unexpected(read.error());
  }
  return content;
}

}  // namespace relievo::io
