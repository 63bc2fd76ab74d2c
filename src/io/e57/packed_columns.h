// The numbers of an E57 file: a CompressedVector section is a sequence of packets. Each packet has a part of
// every column, with numbers packed bit by bit.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/e57/pages.h"

namespace relievo::io {

// A column of numbers, and how they are packed.
struct PackedColumn {
  enum class Kind : std::uint8_t { integer, float32, float64 };

  std::string_view name;  // name of the column, for messages
  Kind kind = Kind::integer;
  unsigned bits = 0;            // bits per number; an integer of 0 bits is always the minimum
  std::int64_t minimum = 0;     // added to integers
  double scale = 1, shift = 0;  // the value is scale * number + shift
  bool is_wanted = false;       // columns that are not wanted have no bytes
  std::string bytes = {};       // bytes of all packets, in their order, followed by zeros

  double value(std::uint64_t row) const;
};

// A section, given by the offset of its header in the file.
struct E57Section {
  std::uint64_t physical_offset = 0;
  std::uint64_t rows = 0;
};

// Collects the bytes of the wanted columns. `columns` are all columns of the section, in the section's order.
// Errors name the byte of the file, or the column that is too short.
Result<void> read_packed_columns(const Source& source, const E57Pages& pages, const E57Section& section,
                                 std::span<PackedColumn> columns);

}  // namespace relievo::io
