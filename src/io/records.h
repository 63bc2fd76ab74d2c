// Points in rows of equal size, as in binary PLY, PCD and LAS. Any block of rows can be decoded
// independently.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "io/numbers.h"
#include "relievo/scan/cloud.h"

namespace relievo::io {

struct RecordColumn {
  NumberType type = NumberType::float32;
  std::size_t at = 0;           // byte offset within a row
  double scale = 1, shift = 0;  // the value is scale * number + shift
};

struct Records {
  std::uint64_t offset = 0;  // offset of the first row in the file
  std::uint64_t count = 0;   // number of rows
  std::size_t stride = 0;    // bytes from row to row
  bool is_big_endian = false;
  std::array<RecordColumn, 3> position;
  std::optional<std::array<RecordColumn, 3>> normal, colour;  // colours scaled to [0, 255]
};

// The rows of a file that can be read piece by piece.
struct StreamRecords {
  Records records;
  std::string format;              // shown to people
  std::uint64_t faces = 0;         // faces of a mesh, which are not read
  bool may_end_early = false;      // a file with fewer rows than promised is read up to its end
  std::uint64_t missing_rows = 0;  // promised, but missing because the file ends early
};

// Returns a cloud of `points` points, with normals and colours if the records have them; all values are
// unset.
Cloud sized_cloud(const Records& records, std::size_t points);

// Decodes `rows` rows, which start at `first`, into the cloud from point `begin` on. Normals are as
// unit_normal() returns them.
void decode_rows(const Records& records, const char* first, std::size_t rows, Cloud& cloud,
                 std::size_t begin);

// Decodes all rows, which start at `first`, concurrently.
Cloud decode_all(const Records& records, const char* first);

}  // namespace relievo::io
