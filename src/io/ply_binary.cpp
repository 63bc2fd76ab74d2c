#include <utility>
#include <vector>

#include "io/ply.h"
#include "io/records.h"
#include "io/text.h"

namespace relievo::io {
namespace {

// Walks over the bytes of the body; row by row if rows have lists.
class BinaryRows {
 public:
  BinaryRows(const Source& source, const PlyHeader& header)
      : source_(source), format_(header.format), at_(header.data_offset) {}

  std::size_t offset() const { return at_; }

  // Returns an error if `element` does not fit into the remaining bytes, even with empty lists.
  Result<void> check_room(const PlyElement& element) const {
    const std::size_t row = least_row_size(element), left = source_.bytes.size() - at_;
    if (row == 0 || element.count <= left / row) return {};
    return source_.error_at_byte(
        at_, "expected " + std::to_string(element.count) + " rows of element " + printable(element.name) +
                 " of " + std::to_string(row) + (has_lists(element) ? " bytes or more" : " bytes") +
                 ", found " + std::to_string(left) + " bytes, enough for " + std::to_string(left / row));
  }

  Result<void> skip(const PlyElement& element) {
    if (const auto room = check_room(element); !room) return room;
    if (!has_lists(element)) {
      at_ += static_cast<std::size_t>(element.count) * least_row_size(element);
      return {};
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      const auto ignore = [](auto...) {};
      if (const auto walked = walk_row(element, ignore, ignore); !walked) return walked;
    }
    return {};
  }

  // Returns an error at the byte after the last complete row.
  Result<void> fail(std::string expected) const { return source_.error_at_byte(at_, std::move(expected)); }

  bool is_big_endian() const { return format_ == PlyFormat::big_endian; }

  // Calls use(property number, its first byte) for each single value of the next row, and use_list(property
  // number, first byte, length) for each list.
  template <typename Use, typename UseList>
  Result<void> walk_row(const PlyElement& element, Use&& use, UseList&& use_list) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list()) {
        const auto length = list_length(property);
        if (!length) return std::unexpected(length.error());
        at_ += size_in_bytes(*property.count_type);
        use_list(i, source_.bytes.data() + at_, *length);
        at_ += *length * size_in_bytes(property.type);
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

  // Returns the length of the list that begins here; nothing if so many values cannot follow.
  Result<std::size_t> list_length(const PlyProperty& list) {
    if (left() < size_in_bytes(*list.count_type)) return std::unexpected(fail_at_end(list).error());
    double length = 0;
    decoder(*list.count_type, is_big_endian())(source_.bytes.data() + at_, 0, 1, &length);
    const std::size_t begin = at_ + size_in_bytes(*list.count_type);
    const double most = static_cast<double>((source_.bytes.size() - begin) / size_in_bytes(list.type));
    if (length < 0 || length > most) {
      const auto number = std::to_string(static_cast<std::int64_t>(length));
      return source_.error_at_byte(at_, "expected the length of the list " + printable(list.name) +
                                            ", found " + number + ", and there is room for " +
                                            std::to_string(static_cast<std::int64_t>(most)));
    }
    return static_cast<std::size_t>(length);
  }

  Result<void> fail_at_end(const PlyProperty& property) const {
    return source_.error_at_byte(
        at_, "expected property " + printable(property.name) + ", found the end of the file");
  }

  const Source& source_;
  PlyFormat format_;
  std::size_t at_;
};

// Rows with lists have different sizes: each is copied without its lists, and the copies are decoded as
// usual.
Result<void> read_rows_with_lists(const PlyBody& body, BinaryRows& rows, Cloud& cloud) {
  PlyElement plain = body.vertex;
  std::vector<char> bytes;
  std::vector<std::size_t> place(plain.properties.size());  // where each property is in the copy
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
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (const auto walked = rows.walk_row(body.vertex, take, [](auto...) {}); !walked) return walked;
    decode_rows(records, bytes.data(), 1, cloud, i);
  }
  return {};
}

Result<void> read_faces(const PlyElement& element, const FaceList& list, BinaryRows& rows,
                        PlyContent& content) {
  if (const auto room = rows.check_room(element); !room) return room;
  const NumberType type = element.properties[list.property].type;
  std::vector<double> values;
  std::vector<std::int64_t> corners;
  const auto take = [&](std::size_t property, const char* first, std::size_t length) {
    if (property != list.property) return;
    values.resize(length);
    decoder(type, rows.is_big_endian())(first, size_in_bytes(type), length, values.data());
    corners.clear();
    for (const double v : values) {
      const bool is_number = v >= -1 && v <= static_cast<double>(no_index);  // false for a NaN
      corners.push_back(is_number ? static_cast<std::int64_t>(v) : -2);
    }
  };
  for (std::uint64_t row = 0; row < element.count; ++row) {
    if (const auto walked = rows.walk_row(
            element, [](auto...) {}, take);
        !walked)
      return walked;
    if (!add_face(corners, list.kind, content.cloud.points, content.triangles))
      return rows.fail(expected_corners(corners, content.cloud.points) + " in row " + std::to_string(row) +
                       " of element " + printable(element.name));
  }
  return {};
}

}  // namespace

Result<PlyContent> read_binary_body(const PlyBody& body) {
  BinaryRows rows(body.source, body.header);
  std::vector<std::pair<const PlyElement*, BinaryRows>> early_faces;
  for (const PlyElement& element : body.before) {
    if (find_face_list(element)) early_faces.emplace_back(&element, rows);
    RELIEVO_CHECK(rows.skip(element));
  }
  RELIEVO_CHECK(rows.check_room(body.vertex));
  PlyContent content;
  if (!has_lists(body.vertex)) {
    content.cloud = decode_all(vertex_records(body.header, body.vertex, body.columns),
                               body.source.bytes.data() + rows.offset());
    if (const auto skipped = rows.skip(body.vertex); !skipped) return std::unexpected(skipped.error());
  } else {
    content.cloud = sized_cloud(body.vertex.count, body.columns);
    if (const auto read = read_rows_with_lists(body, rows, content.cloud); !read)
      return std::unexpected(read.error());
  }
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
