#include "io/e57/pages.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

#include "io/numbers.h"
#include "io/text.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::size_t checksum_size = 4, header_size = 48;

using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

// Makes tables for processing eight bytes per step ("slicing by 8", Kounavis and Berry 2008). Table k is for
// a byte that is followed by k more bytes.
constexpr CrcTables make_crc_tables() {
  constexpr std::uint32_t polynomial = 0x82F63B78;  // Castagnoli's polynomial, with its bits reversed
  CrcTables tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) * polynomial);
    tables[0][i] = crc;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t i = 0; i < 256; ++i)
      tables[k][i] = (tables[k - 1][i] >> 8) ^ tables[0][tables[k - 1][i] & 0xFF];
  return tables;
}

constexpr CrcTables crc_tables = make_crc_tables();

// The checksum is the only big-endian number of the format.
std::uint32_t stored_checksum(std::string_view page) {
  return std::byteswap(little<std::uint32_t>(page.data() + page.size() - checksum_size));
}

Result<std::uint64_t> check_header(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (!bytes.starts_with("ASTM-E57"))
    return source.error_at_byte(0, "expected ASTM-E57, found " + in_quotes(bytes.substr(0, 8)));
  if (bytes.size() < header_size)
    return source.error_at_byte(bytes.size(), "expected a header of 48 bytes, found the end of the file");
  const auto major = little<std::uint32_t>(bytes.data() + 8),
             minor = little<std::uint32_t>(bytes.data() + 12);
  if (major != 1) return source.error_at_byte(8, cat("expected E57 1.0, found ", major, ".", minor));
  const auto length = little<std::uint64_t>(bytes.data() + 16),
             page = little<std::uint64_t>(bytes.data() + 40);
  if (page < 64 || page > 1 << 20)
    return source.error_at_byte(40, cat("expected pages of 64 to 1048576 bytes, found ", page));
  if (length > bytes.size() || length == 0 || length % page != 0)
    return source.error_at_byte(
        16, cat("expected a file of ", length, " bytes, in pages of ", page, ", found ", bytes.size()));
  return length / page;
}

constexpr std::size_t section_header = 32, data_header = 6;
constexpr std::size_t padding = 9;  // zeros after the bytes, so that 64 bits can be read at any bit position

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

std::uint32_t crc32c(std::string_view bytes) {
  std::uint32_t crc = ~std::uint32_t{0};
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = little<std::uint64_t>(bytes.data() + i) ^ crc;
    crc = 0;
    for (std::size_t k = 8; k-- > 0; word >>= 8) crc ^= crc_tables[k][word & 0xFF];
  }
  for (; i < bytes.size(); ++i)
    crc = (crc >> 8) ^ crc_tables[0][(crc ^ static_cast<unsigned char>(bytes[i])) & 0xFF];
  return ~crc;
}

std::uint64_t E57Pages::logical(std::uint64_t physical) const {
  const std::uint64_t in_page = physical % page_size, content = page_size - checksum_size;
  return in_page < content ? physical / page_size * content + in_page : bytes.size();
}

std::uint64_t E57Pages::physical(std::uint64_t logical) const {
  const std::uint64_t content = page_size - checksum_size;
  return logical / content * page_size + logical % content;
}

Result<void> read_e57_pages(const Source& source, E57Pages& pages) {
  RELIEVO_TRY(const std::uint64_t count, check_header(source));
  pages.page_size = little<std::uint64_t>(source.bytes.data() + 40);
  const std::size_t content = pages.page_size - checksum_size;
  pages.bytes.resize(count * content);
  std::atomic<std::size_t> damaged = count;
  parallel_for(
      count,
      [&](std::size_t i) {
        const std::string_view page = source.bytes.substr(i * pages.page_size, pages.page_size);
        std::copy_n(page.data(), content, pages.bytes.data() + i * content);
        if (crc32c(page.substr(0, content)) == stored_checksum(page)) return;
        std::size_t first = damaged;
        while (i < first && !damaged.compare_exchange_weak(first, i)) continue;
      },
      256);
  if (damaged < count)
    return source.error_at_byte(
        damaged * pages.page_size,
        cat("expected page ", damaged + 1, " of ", count,
            " as its checksum says, found bytes of another checksum; the file is damaged, get it anew"));
  const std::uint64_t xml = pages.logical(little<std::uint64_t>(source.bytes.data() + 24)),
                      length = little<std::uint64_t>(source.bytes.data() + 32);
  if (length == 0 || length > pages.bytes.size() - std::min<std::uint64_t>(xml, pages.bytes.size()))
    return source.error_at_byte(24,
                                cat("expected ", length, " bytes of XML within the file, found ",
                                    pages.bytes.size() - std::min<std::uint64_t>(xml, pages.bytes.size())));
  pages.xml = std::string_view(pages.bytes).substr(xml, length);
  return {};
}

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
