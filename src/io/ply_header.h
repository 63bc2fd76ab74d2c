// The header of a PLY file, which states the elements that follow and the layout of their rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "io/numbers.h"
#include "io/readers.h"

namespace relievo::io {

struct PlyProperty {
  std::string_view name;
  NumberType type;                       // type of the value, or of each value of the list
  std::optional<NumberType> count_type;  // type of a list's length, an integer; for lists only

  bool is_list() const { return count_type.has_value(); }
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;  // number of rows as stated in the header, which may be wrong
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  // line of its declaration
};

// Returns the smallest size of a binary row in bytes, with all lists empty.
std::size_t least_row_size(const PlyElement& element);

// Returns true if any property is a list, so that the rows' sizes differ.
bool has_lists(const PlyElement& element);

enum class PlyFormat { ascii, little_endian, big_endian };

// Views point into the source.
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t data_offset = 0;  // byte after the header
  std::size_t lines = 0;        // lines of the header
};

// Returns the header. Errors name the line.
Result<PlyHeader> read_ply_header(const Source& source);

}  // namespace relievo::io
