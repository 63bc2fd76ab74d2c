// Finds the size of a scan from the beginning of its file, so that the needed memory is known before the scan
// is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace relievo {

struct ScanSize {
  std::uint64_t points = 0, triangles = 0, pixels = 0;
  bool is_stated = false;  // true if the header states the size; else it is estimated from the file's
};

// Returns the number of points and triangles of a cloud or mesh, or of pixels of a depth image, in a file of
// `file_bytes` bytes that begins with `head`: PLY, PCD, LAS, binary STL and PNG state these numbers; for
// other formats they are estimated. 64 kB of `head` suffice. A header may promise anything, so the result is
// limited to the numbers that fit into the file. All numbers are 0 for an empty file.
ScanSize scan_size(std::span<const std::byte> head, std::string_view name, std::uint64_t file_bytes);

}  // namespace relievo
