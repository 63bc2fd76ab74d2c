#include "io/ply.h"
#include "io/records.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

// Walks over the bytes of the body, row by row if rows have lists.
class BinaryRows {
 public:
  BinaryRows(const Source& source, const PlyHeader& header)
      : source_(source), format_(header.format), at_(header.data_offset) {}

  std::size_t offset() const { return at_; }

  // Begins an element. Returns an error if it does not fit into the remaining bytes, even with empty lists.
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

  // Appends the corners of the face in the next row.
  Result<void> read_face(const PlyElement& element, const FaceList& list,
                         std::vector<std::int64_t>& corners) {
    const NumberType type = element.properties[list.property].type;
    const auto take = [&](std::size_t property, const char* first, std::size_t length) {
      if (property != list.property) return;
      values_.resize(length);
      decoder(type, is_big_endian())(first, size_in_bytes(type), length, values_.data());
      for (const double v : values_) {
        const bool is_number = v >= -1 && v <= static_cast<double>(no_index);  // false for a NaN
        corners.push_back(is_number ? static_cast<std::int64_t>(v) : -2);
      }
    };
    const auto ignore = [](auto...) {};
    return walk_row(element, ignore, take);
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

  // Returns the length of the list that begins here, or an error if the file is too short for that many
  // values.
  Result<std::size_t> list_length(const PlyProperty& list) {
    if (left() < size_in_bytes(*list.count_type)) return std::unexpected(fail_at_end(list).error());
    double length = 0;
    decoder(*list.count_type, is_big_endian())(source_.bytes.data() + at_, 0, 1, &length);
    const std::size_t begin = at_ + size_in_bytes(*list.count_type);
    const double most = static_cast<double>((source_.bytes.size() - begin) / size_in_bytes(list.type));
    if (length < 0 || length > most) {
      return source_.error_at_byte(at_, cat("expected the length of the list ", printable(list.name),
                                            ", found ", static_cast<std::int64_t>(length),
                                            ", and there is room for ", static_cast<std::int64_t>(most)));
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
  std::vector<double> values_;  // values of the last list; it is reused to keep its memory
};

// Rows with lists differ in size. Each row is therefore copied without its lists, and the copies are decoded
// as usual.
Result<void> read_rows_with_lists(const PlyBody& body, BinaryRows& rows, Cloud& cloud) {
  PlyElement plain = body.vertex;
  std::vector<char> bytes;
  std::vector<std::size_t> place(plain.properties.size());  // index of each property in the copy
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
    RELIEVO_CHECK(rows.walk_row(body.vertex, take, [](auto...) {}));
    decode_rows(records, bytes.data(), 1, cloud, i);
  }
  return {};
}

Result<void> read_vertices(const PlyBody& body, BinaryRows& rows, Cloud& cloud) {
  RELIEVO_CHECK(rows.begin(body.vertex));
  if (has_lists(body.vertex)) {
    cloud = sized_cloud(body.vertex.count, body.columns);
    return read_rows_with_lists(body, rows, cloud);
  }
  cloud = decode_all(vertex_records(body.header, body.vertex, body.columns),
                     body.source.bytes.data() + rows.offset());
  return rows.skip(body.vertex);
}

}  // namespace

Result<PlyContent> read_binary_body(const PlyBody& body) {
  return read_elements(body, BinaryRows(body.source, body.header));
}

}  // namespace relievo::io
