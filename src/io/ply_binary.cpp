#include <bit>
#include <cstring>

#include "io/ply.h"
#include "io/text.h"
#include "relievo/parallel.h"

namespace relievo::io {
namespace {

// Decodes one column: `rows` values, `stride` bytes apart.
using Decode = void (*)(const char* first, std::size_t stride, std::size_t rows, double* values);

template <std::size_t bytes>
struct BitsOf;
template <>
struct BitsOf<1> {
  using type = std::uint8_t;
};
template <>
struct BitsOf<2> {
  using type = std::uint16_t;
};
template <>
struct BitsOf<4> {
  using type = std::uint32_t;
};
template <>
struct BitsOf<8> {
  using type = std::uint64_t;
};

template <typename T, bool is_swapped>
void decode(const char* first, std::size_t stride, std::size_t rows, double* values) {
  for (std::size_t i = 0; i < rows; ++i) {
    typename BitsOf<sizeof(T)>::type bits;
    std::memcpy(&bits, first + i * stride, sizeof(T));
    if constexpr (is_swapped) bits = std::byteswap(bits);
    values[i] = static_cast<double>(std::bit_cast<T>(bits));
  }
}

template <bool is_swapped>
Decode decoder(PlyType type) {
  constexpr std::array<Decode, 8> all = {decode<std::int8_t, is_swapped>,  decode<std::uint8_t, is_swapped>,
                                         decode<std::int16_t, is_swapped>, decode<std::uint16_t, is_swapped>,
                                         decode<std::int32_t, is_swapped>, decode<std::uint32_t, is_swapped>,
                                         decode<float, is_swapped>,        decode<double, is_swapped>};
  return all[static_cast<std::size_t>(type)];
}

Decode decoder(PlyType type, PlyFormat format) {
  const bool is_native = (format == PlyFormat::big_endian) == (std::endian::native == std::endian::big);
  return is_native ? decoder<false>(type) : decoder<true>(type);
}

// Walks over the bytes of the body, row by row where rows have lists.
class BinaryRows {
 public:
  BinaryRows(const Source& source, const PlyHeader& header)
      : source_(source), format_(header.format), at_(header.data_offset) {}

  std::size_t offset() const { return at_; }

  // Error if `element` cannot fit into what is left, even with empty lists.
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
      if (const auto walked = walk_row(element, [](auto...) {}); !walked) return walked;
    }
    return {};
  }

  // Calls use(property number, its first byte) for each single value of the next row.
  template <typename Use>
  Result<void> walk_row(const PlyElement& element, Use&& use) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list()) {
        if (const auto skipped = skip_list(property); !skipped) return skipped;
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

  Result<void> skip_list(const PlyProperty& list) {
    if (left() < size_in_bytes(*list.count_type)) return fail_at_end(list);
    double length = 0;
    decoder(*list.count_type, format_)(source_.bytes.data() + at_, 0, 1, &length);
    const std::size_t begin = at_ + size_in_bytes(*list.count_type);
    const double most = static_cast<double>((source_.bytes.size() - begin) / size_in_bytes(list.type));
    if (length < 0 || length > most) {
      const auto number = std::to_string(static_cast<std::int64_t>(length));
      return source_.error_at_byte(at_, "expected the length of the list " + printable(list.name) +
                                            ", found " + number + ", and there is room for " +
                                            std::to_string(static_cast<std::int64_t>(most)));
    }
    at_ = begin + static_cast<std::size_t>(length) * size_in_bytes(list.type);
    return {};
  }

  Result<void> fail_at_end(const PlyProperty& property) const {
    return source_.error_at_byte(
        at_, "expected property " + printable(property.name) + ", found the end of the file");
  }

  const Source& source_;
  PlyFormat format_;
  std::size_t at_;
};

using Columns = std::array<std::array<double, 1024>, VertexColumns::most>;

void store(const Columns& columns, std::size_t begin, std::size_t end, Cloud& cloud) {
  for (std::size_t i = begin; i < end; ++i) {
    const auto vector = [&, k = i - begin](std::size_t c) {
      return Vec3(columns[c][k], columns[c + 1][k], columns[c + 2][k]);
    };
    cloud.points[i] = vector(0);
    if (cloud.has_normals()) cloud.normals[i] = unit_normal(vector(3));
  }
}

// Rows of equal size: any block of them can be decoded by itself.
void read_equal_rows(const PlyBody& body, const char* first, Cloud& cloud) {
  const std::size_t stride = least_row_size(body.vertex);
  std::array<std::size_t, VertexColumns::most> offsets = {};
  std::array<Decode, VertexColumns::most> decoders = {};
  for (std::size_t c = 0; c < body.columns.count; ++c) {
    const auto& properties = body.vertex.properties;
    decoders[c] = decoder(properties[body.columns.property[c]].type, body.header.format);
    for (std::size_t i = 0; i < body.columns.property[c]; ++i)
      offsets[c] += size_in_bytes(properties[i].type);
  }
  parallel_ranges(cloud.size(), Columns::value_type().size(), [&](std::size_t begin, std::size_t end) {
    Columns columns;
    for (std::size_t c = 0; c < body.columns.count; ++c) {
      decoders[c](first + begin * stride + offsets[c], stride, end - begin, columns[c].data());
    }
    store(columns, begin, end, cloud);
  });
}

Result<void> read_rows_with_lists(const PlyBody& body, BinaryRows& rows, Cloud& cloud) {
  Columns columns;
  const auto take = [&](std::size_t property, const char* first) {
    for (std::size_t c = 0; c < body.columns.count; ++c) {
      if (body.columns.property[c] != property) continue;
      decoder(body.vertex.properties[property].type, body.header.format)(first, 0, 1, columns[c].data());
    }
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (const auto walked = rows.walk_row(body.vertex, take); !walked) return walked;
    store(columns, i, i + 1, cloud);
  }
  return {};
}

}  // namespace

Result<Cloud> read_binary_body(const PlyBody& body) {
  BinaryRows rows(body.source, body.header);
  for (const PlyElement& element : body.before) {
    if (const auto skipped = rows.skip(element); !skipped) return std::unexpected(skipped.error());
  }
  if (const auto room = rows.check_room(body.vertex); !room) return std::unexpected(room.error());
  Cloud cloud = sized_cloud(body.vertex.count, body.columns);
  if (!has_lists(body.vertex)) {
    read_equal_rows(body, body.source.bytes.data() + rows.offset(), cloud);
  } else if (const auto read = read_rows_with_lists(body, rows, cloud); !read) {
    return std::unexpected(read.error());
  }
  return cloud;
}

}  // namespace relievo::io
