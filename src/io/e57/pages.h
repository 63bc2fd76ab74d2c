// Reads the pages of an E57 file, which are blocks of 1,024 bytes. The last four bytes of a page are a
// checksum. Physical offsets, which the file uses, include the checksums; logical offsets and lengths do not
// include them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/readers.h"

namespace relievo::io {

// Returns the CRC-32C (Castagnoli) of the bytes.
std::uint32_t crc32c(std::string_view bytes);

struct E57Pages {
  std::string bytes;          // the contents of all pages
  std::size_t page_size = 0;  // in bytes, including the checksum
  std::string_view xml;       // the XML of the file, a part of `bytes`

  E57Pages() = default;
  E57Pages(E57Pages&&) = delete;  // not movable, because `xml` points into `bytes`

  // Convert between physical and logical offsets. A physical offset inside a checksum is invalid; its logical
  // offset is the end of `bytes`.
  std::uint64_t logical(std::uint64_t physical) const;
  std::uint64_t physical(std::uint64_t logical) const;
};

// Reads the header, verifies all checksums, and copies the contents of the pages. An error states
// the position of the wrong byte or, for a wrong checksum, the page.
Result<void> read_e57_pages(const Source& source, E57Pages& pages);

// The numbers of an E57 file are stored as follows. A CompressedVector section is a sequence of packets. Each
// packet has a part of every column. The numbers of a column are packed bit by bit.

// A column of numbers, and how they are packed.
struct PackedColumn {
  enum class Kind : std::uint8_t { integer, float32, float64 };

  std::string_view name;  // name of the column, for messages
  Kind kind = Kind::integer;
  unsigned bits = 0;            // bits per number; an integer of 0 bits always equals the minimum
  std::int64_t minimum = 0;     // added to the stored integers
  double scale = 1, shift = 0;  // the value is scale * number + shift
  bool is_wanted = false;       // the bytes of unwanted columns are not collected
  std::string bytes = {};       // bytes of all packets in order, followed by zeros

  double value(std::uint64_t row) const;
};

// A section, given by the offset of its header in the file.
struct E57Section {
  std::uint64_t physical_offset = 0;
  std::uint64_t rows = 0;
};

// Collects the bytes of the wanted columns (PackedColumn::is_wanted). `columns` are all columns of the
// section, in order. Errors name the byte of the file, or the column that is too short.
Result<void> read_packed_columns(const Source& source, const E57Pages& pages, const E57Section& section,
                                 std::span<PackedColumn> columns);

}  // namespace relievo::io
