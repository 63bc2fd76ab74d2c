// The header of LAS and LAZ files.
#pragma once

#include "io/readers.h"
#include "io/records.h"

namespace relievo::io {

struct LasHeader {
  Records records;         // of LAZ, as they are when decompressed; `offset` is that of the compressed points
  int minor = 0;           // of the version, 1.0 to 1.5
  std::size_t format = 0;  // of the points, 0 to 10
  bool is_compressed = false;
  std::size_t header_size = 0;  // variable-length records follow
  std::size_t variable_records = 0;
};

// Reads the header. Whether colours have 8 or 16 bits is seen from the first points, if these are not compressed.
Result<LasHeader> read_las_header(const Source& source);

}  // namespace relievo::io
