// Reads the header of LAS and LAZ files.
#pragma once

#include <string_view>

#include "io/numbers.h"
#include "io/readers.h"

namespace relievo::io {

struct LasHeader {
  Records records;  // for LAZ, the layout after decompression, with the offset of the compressed points
  int minor = 0;    // minor version, 1.0 to 1.5
  std::size_t format = 0;  // point format, 0 to 10
  bool is_compressed = false;
  std::size_t header_size = 0;  // in bytes; variable-length records follow the header
  std::size_t variable_records = 0;
};

// Describes the points that are left out: low noise, high noise, and points that the file marks as withheld,
// which readers should treat as deleted.
constexpr std::string_view what_las_leaves_out =
    "that the file marks as noise (classes 7 and 18) or withheld; --doubtful keep keeps them";
constexpr bool is_left_out(unsigned classification, bool is_withheld) {
  return classification == 7 || classification == 18 || is_withheld;
}

// Reads the header. If the points are not compressed, the first points show whether colours have 8 or 16
// bits.
Result<LasHeader> read_las_header(const Source& source);

}  // namespace relievo::io
