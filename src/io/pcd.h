// The header of a PCD file, which states the layout of a point's numbers.
#pragma once

#include <array>
#include <vector>

#include "io/readers.h"
#include "io/records.h"

namespace relievo::io {

enum class PcdData { ascii, binary, compressed };

struct PcdHeader {
  PcdData data = PcdData::ascii;
  Records records;                       // layout of the points; ascii files use only `count`
  std::vector<std::size_t> field_sizes;  // bytes of each field of a point
  std::size_t lines = 0;                 // lines of the header
  // The indices of the words of an ascii row, and their number.
  std::size_t columns = 0;
  std::array<std::size_t, 3> position_columns = {}, normal_columns = {};
  std::size_t colour_column = 0;
  bool is_colour_float = false;  // the colour is in the bits of the float, not in its value
};

// Returns the header. Errors name the line.
Result<PcdHeader> read_pcd_header(const Source& source);

}  // namespace relievo::io
