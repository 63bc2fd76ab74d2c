#include "io/e57/packed_columns.h"

#include <bit>

#include "io/numbers.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::size_t section_header = 32, data_header = 6;
constexpr std::size_t padding = 9;  // so that 64 bits can be read from any bit position

std::uint64_t bits_at(const char* bytes, std::uint64_t bit, unsigned count) {
  const char* const first = bytes + bit / 8;
  const auto shift = static_cast<unsigned>(bit % 8);
  std::uint64_t value = little<std::uint64_t>(first) >> shift;
  if (shift + count > 64) value |= std::uint64_t{static_cast<unsigned char>(first[8])} << (64 - shift);
  return count == 64 ? value : value & ((std::uint64_t{1} << count) - 1);
}

class PacketReader {
 public:
  PacketReader(const Source& source, const E57Pages& pages, std::span<PackedColumn> columns)
      : source_(source), pages_(pages), columns_(columns) {}

  Result<void> read(const E57Section& section) {
    RELIEVO_CHECK(open(section));
    while (at_ < end_ && !has_all(section.rows)) RELIEVO_CHECK(take_packet());
    for (PackedColumn& column : columns_) {
      const std::uint64_t found = column.bits == 0 ? section.rows : column.bytes.size() * 8 / column.bits;
      if (column.is_wanted && found < section.rows)
        return error(at_, cat("expected ", section.rows, " numbers of ", column.name, ", found ", found));
      column.bytes.append(padding, '\0');
    }
    return {};
  }

 private:
  std::unexpected<Error> error(std::uint64_t logical, std::string expected) const {
    return source_.error_at_byte(pages_.physical(logical), std::move(expected));
  }

  template <typename T>
  T number(std::uint64_t at) const {
    return little<T>(pages_.bytes.data() + at);
  }

  Result<void> open(const E57Section& section) {
    const std::uint64_t size = pages_.bytes.size(), at = pages_.logical(section.physical_offset);
    if (at > size || size - at < section_header)
      return source_.error_at_byte(section.physical_offset, "expected points, found the end of the file");
    if (number<std::uint8_t>(at) != 1)
      return error(at, cat("expected a section of compressed vectors, number 1, found ",
                           static_cast<int>(number<std::uint8_t>(at))));
    const auto length = number<std::uint64_t>(at + 8);
    at_ = pages_.logical(number<std::uint64_t>(at + 16));
    if (length < section_header || length > size - at || at_ < at || at_ > at + length)
      return error(at, cat("expected a section within the file, with its packets in it, found ", length,
                           " bytes of which the packets begin at byte ", number<std::uint64_t>(at + 16)));
    end_ = at + length;
    return {};
  }

  bool has_all(std::uint64_t rows) const {
    for (const PackedColumn& column : columns_)
      if (column.is_wanted && column.bytes.size() * 8 / std::max(1U, column.bits) < rows && column.bits > 0)
        return false;
    return true;
  }

  Result<void> take_packet() {
    const std::uint64_t left = end_ - at_;
    const std::uint64_t length = left < 4 ? 0 : std::uint64_t{1} + number<std::uint16_t>(at_ + 2);
    if (length < 4 || length > left)
      return error(at_, cat("expected a packet within its section, of which ", left,
                            " bytes are left, found ", length, " bytes"));
    const auto type = number<std::uint8_t>(at_);
    if (type > 2)
      return error(at_,
                   cat("expected an index, data or empty packet (0 to 2), found ", static_cast<int>(type)));
    if (type == 1) RELIEVO_CHECK(take_data(length));
    at_ += length;
    return {};
  }

  Result<void> take_data(std::uint64_t length) {
    const std::size_t streams = length < data_header ? 0 : number<std::uint16_t>(at_ + 4);
    if (streams != columns_.size())
      return error(at_ + 4, cat("expected ", columns_.size(), " columns, found ", streams));
    std::uint64_t next = data_header + 2 * streams;
    for (std::size_t i = 0; i < streams; ++i) {
      if (next > length) break;
      const std::uint64_t size = number<std::uint16_t>(at_ + data_header + 2 * i);
      if (columns_[i].is_wanted && next + size <= length)
        columns_[i].bytes.append(pages_.bytes, at_ + next, size);
      next += size;
    }
    if (next <= length) return {};
    return error(at_, cat("expected columns within a packet of ", length, " bytes, found ", next));
  }

  const Source& source_;
  const E57Pages& pages_;
  std::span<PackedColumn> columns_;
  std::uint64_t at_ = 0, end_ = 0;
};

}  // namespace

double PackedColumn::value(std::uint64_t row) const {
  const std::uint64_t number = bits_at(bytes.data(), row * bits, bits);
  if (kind == Kind::float64) return std::bit_cast<double>(number);
  if (kind == Kind::float32) return std::bit_cast<float>(static_cast<std::uint32_t>(number));
  const auto sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(minimum) + number);
  return scale * static_cast<double>(sum) + shift;
}

Result<void> read_packed_columns(const Source& source, const E57Pages& pages, const E57Section& section,
                                 std::span<PackedColumn> columns) {
  return PacketReader(source, pages, columns).read(section);
}

}  // namespace relievo::io
