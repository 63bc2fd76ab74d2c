#include <algorithm>
#include <limits>

#include "io/ply.h"

namespace relievo::io {
namespace {

template <typename Rows>
Result<void> read_faces(const PlyElement& element, const FaceList& list, Rows& rows, PlyContent& content) {
  RELIEVO_CHECK(rows.begin(element));
  std::vector<std::int64_t> corners;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    corners.clear();
    RELIEVO_CHECK(rows.read_face(element, list, corners));
    if (!add_face(corners, list.kind, content.cloud.points, content.triangles))
      return rows.fail(cat(expected_corners(corners, content.cloud.points), " in row ", row, " of element ",
                           printable(element.name)));
  }
  return {};
}

// Reads a body through `rows`, which are ascii or binary. Faces that precede the vertices are read after the
// vertices.
template <typename Rows>
Result<PlyContent> read_elements(const PlyBody& body, Rows rows) {
  std::vector<std::pair<const PlyElement*, Rows>> early_faces;
  for (const PlyElement& element : body.before) {
    if (find_face_list(element)) early_faces.emplace_back(&element, rows);
    RELIEVO_CHECK(rows.skip(element));
  }
  PlyContent content;
  RELIEVO_CHECK(read_vertices(body, rows, content));
  for (auto& [element, at] : early_faces)
    RELIEVO_CHECK(read_faces(*element, *find_face_list(*element), at, content));
  for (const PlyElement& element : body.after) {
    const auto list = find_face_list(element);
    RELIEVO_CHECK(list ? read_faces(element, *list, rows, content) : rows.skip(element));
  }
  return content;
}

// Reads rows of text. Each row begins on a new line, and may continue on several lines.
class AsciiRows {
 public:
  AsciiRows(const Source& source, const PlyHeader& header)
      : lines_(source, header.data_offset, header.lines) {}

  // Calls use(property index, word) for each single value of the next row, and use_item(property index, word)
  // for each list item. Both return false to refuse a word.
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
    // MeshLab writes colours for the corners of faces without declaring them. So too many words are an error
    // only in vertex rows.
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
  // Returns the next word, from this line or a later one; no text at the end of the file.
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
    if (!length || *length < 0)
      return fail("expected the length of the list " + printable(list.name) + ", found " + in_quotes(word));
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
  std::uint64_t rows_ = 0;  // number of complete rows of the current element
};

// Returns whether this many bytes can contain the rows of the element. Each value takes at least two bytes, a
// digit and a separator; only the last value of the file needs no separator.
bool can_hold(std::size_t bytes, const PlyElement& element) {
  return element.count <= (bytes + 1) / (2 * element.properties.size());
}

// Reads the vertices. If the header promises more vertices than the bytes can contain, allocates no memory
// for them; reading then ends with an error.
Result<void> read_vertices(const PlyBody& body, AsciiRows& rows, PlyContent& content) {
  Cloud& cloud = content.cloud;
  const std::size_t left = body.source.bytes.size() - body.header.data_offset;
  cloud = sized_cloud(vertex_records(body.header, body.vertex, body.columns),
                      can_hold(left, body.vertex) ? body.vertex.count : 0);
  std::vector<std::size_t> column_of(body.vertex.properties.size(), VertexColumns::most);
  for (std::size_t c = 0; c < VertexColumns::most; ++c)
    if (body.columns.is_there[c]) column_of[body.columns.property[c]] = c;
  const RecordColumn colour =
      body.columns.has_colours()
          ? colour_column(body.columns, body.vertex.properties[body.columns.property[6]].type)
          : RecordColumn{};
  std::array<double, VertexColumns::most> values = {};
  values[12] = no_depth;
  const auto take = [&](std::size_t property, std::string_view word) {
    if (column_of[property] == VertexColumns::most) return true;  // not read; it may be a text, such as True
    const auto value = parse_number(word);
    if (value) values[column_of[property]] = *value;
    return value.has_value();
  };
  const auto byte = [&](double v) { return as_byte(colour.scale * v + colour.shift); };
  for (std::size_t i = 0; i < body.vertex.count; ++i) {
    if (const auto read = rows.read_row(body.vertex, take, [](auto...) { return true; }); !read) return read;
    if (i >= cloud.size()) continue;
    cloud.points[i] = Vec3(values[0], values[1], values[2]);
    if (cloud.has_normals()) cloud.normals[i] = unit_normal(Vec3(values[3], values[4], values[5]));
    if (cloud.has_colours()) cloud.colours[i] = {byte(values[6]), byte(values[7]), byte(values[8])};
    if (!cloud.axes.empty())
      cloud.axes[i] = splat_axis(Vec3(values[10], values[11], values[12]),
                                 {values[13], values[14], values[15], values[16]});
    if (!body.columns.has_faint(values[9])) continue;
    cloud.points[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    ++content.faint;
  }
  return {};
}

// Iterates over the bytes of the body, row by row if rows have lists.
class BinaryRows {
 public:
  BinaryRows(const Source& source, const PlyHeader& header)
      : source_(source), format_(header.format), at_(header.data_offset) {}

  std::size_t offset() const { return at_; }

  // Begins an element. Returns an error if it does not fit into the remaining bytes even with empty lists.
  Result<void> begin(const PlyElement& element) const {
    const std::size_t row = least_row_size(element), left = source_.bytes.size() - at_;
    if (row == 0 || element.count <= left / row) return {};
    return fail(cat("expected ", element.count, " rows of element ", printable(element.name), " of ", row,
                    has_lists(element) ? " bytes or more" : " bytes", ", found ", left, " bytes, enough for ",
                    left / row));
  }

  Result<void> skip(const PlyElement& element) {
    RELIEVO_CHECK(begin(element));
    if (!has_lists(element)) {
      at_ += static_cast<std::size_t>(element.count) * least_row_size(element);
      return {};
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      const auto ignore = [](auto...) {};
      RELIEVO_CHECK(walk_row(element, ignore, ignore));
    }
    return {};
  }

  Result<void> read_face(const PlyElement& element, const FaceList& list,
                         std::vector<std::int64_t>& corners) {
    const NumberType type = element.properties[list.property].type;
    const auto take = [&](std::size_t property, const char* first, std::size_t length) {
      if (property != list.property) return;
      values_.resize(length);
      decoder(type, is_big_endian())(first, size_in_bytes(type), length, values_.data());
      for (const double v : values_) {
        const bool is_number = v >= -1 && v <= static_cast<double>(no_index);  // false for NaN
        corners.push_back(is_number ? static_cast<std::int64_t>(v) : -2);
      }
    };
    const auto ignore = [](auto...) {};
    return walk_row(element, ignore, take);
  }

  // Returns an error at the byte after the last complete row.
  Result<void> fail(std::string expected) const { return source_.error_at_byte(at_, std::move(expected)); }

  bool is_big_endian() const { return format_ == PlyFormat::big_endian; }

  // Calls use(property index, address of the value) for each single value of the next row, and
  // use_list(property index, address of the first value, length) for each list.
  template <typename Use, typename UseList>
  Result<void> walk_row(const PlyElement& element, Use&& use, UseList&& use_list) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list()) {
        RELIEVO_TRY(const auto length, list_length(property));
        at_ += size_in_bytes(*property.count_type);
        use_list(i, source_.bytes.data() + at_, length);
        at_ += length * size_in_bytes(property.type);
      } else {
        if (left() < size_in_bytes(property.type)) return fail_at_end(property);
        use(i, source_.bytes.data() + at_);
        at_ += size_in_bytes(property.type);
      }
    }
    return {};
  }

 private:
  std::size_t left() const { return source_.bytes.size() - at_; }

  // Returns the length of the list that begins at the current byte. Returns an error if the file is too short
  // for that many values.
  Result<std::size_t> list_length(const PlyProperty& list) {
    if (left() < size_in_bytes(*list.count_type)) return std::unexpected(fail_at_end(list).error());
    double length = 0;
    decoder(*list.count_type, is_big_endian())(source_.bytes.data() + at_, 0, 1, &length);
    const std::size_t begin = at_ + size_in_bytes(*list.count_type);
    const double most = static_cast<double>((source_.bytes.size() - begin) / size_in_bytes(list.type));
    if (length < 0 || length > most)
      return source_.error_at_byte(at_, cat("expected the length of the list ", printable(list.name),
                                            ", found ", static_cast<std::int64_t>(length),
                                            ", and there is room for ", static_cast<std::int64_t>(most)));
    return static_cast<std::size_t>(length);
  }

  Result<void> fail_at_end(const PlyProperty& property) const {
    return source_.error_at_byte(
        at_, "expected property " + printable(property.name) + ", found the end of the file");
  }

  const Source& source_;
  PlyFormat format_;
  std::size_t at_;
  std::vector<double> values_;  // values of the last list; a member to reuse its memory
};

// Rows with lists differ in size. So each row is copied without its lists, and the copies are decoded like
// rows of equal size.
Result<void> read_rows_with_lists(const PlyBody& body, BinaryRows& rows, PlyContent& content) {
  PlyElement plain = body.vertex;
  std::vector<char> bytes;
  std::vector<std::size_t> place(plain.properties.size());  // byte offset of each property in the copy
  for (std::size_t i = 0; i < plain.properties.size(); ++i) {
    place[i] = bytes.size();
    if (!plain.properties[i].is_list()) bytes.resize(bytes.size() + size_in_bytes(plain.properties[i].type));
  }
  Records records = vertex_records(body.header, plain, body.columns);
  const auto move_columns = [&](std::array<RecordColumn, 3>& columns, std::size_t c) {
    for (std::size_t i = 0; i < 3; ++i) columns[i].at = place[body.columns.property[c + i]];
  };
  move_columns(records.position, 0);
  if (records.normal) move_columns(*records.normal, 3);
  if (records.colour) move_columns(*records.colour, 6);
  const auto take = [&](std::size_t property, const char* first) {
    std::memcpy(bytes.data() + place[property], first, size_in_bytes(plain.properties[property].type));
  };
  for (std::size_t i = 0; i < content.cloud.size(); ++i) {
    RELIEVO_CHECK(rows.walk_row(body.vertex, take, [](auto...) {}));
    decode_rows(records, bytes.data(), 1, content.cloud, i);
    content.faint += count_left_out(records, bytes.data(), 1);
  }
  return {};
}

Result<void> read_vertices(const PlyBody& body, BinaryRows& rows, PlyContent& content) {
  RELIEVO_CHECK(rows.begin(body.vertex));
  const Records records = vertex_records(body.header, body.vertex, body.columns);
  if (has_lists(body.vertex)) {
    content.cloud = sized_cloud(records, body.vertex.count);
    return read_rows_with_lists(body, rows, content);
  }
  const char* const first = body.source.bytes.data() + rows.offset();
  content.cloud = decode_all(records, first);
  content.faint = count_left_out(records, first, body.vertex.count);
  return rows.skip(body.vertex);
}

}  // namespace

Result<PlyContent> read_ascii_body(const PlyBody& body) {
  return read_elements(body, AsciiRows(body.source, body.header));
}

Result<PlyContent> read_binary_body(const PlyBody& body) {
  return read_elements(body, BinaryRows(body.source, body.header));
}

}  // namespace relievo::io
