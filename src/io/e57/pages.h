// The pages of an E57 file. A file is divided into pages of 1,024 bytes, of which the last four are a
// checksum. Physical offsets, which the file states, include the checksums; logical offsets and lengths do
// not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/readers.h"

namespace relievo::io {

// Returns the CRC-32C (Castagnoli) of the bytes.
std::uint32_t crc32c(std::string_view bytes);

struct E57Pages {
  std::string bytes;          // the contents of all pages
  std::size_t page_size = 0;  // with the checksum
  std::string_view xml;       // a part of `bytes`

  E57Pages() = default;
  E57Pages(E57Pages&&) = delete;  // `xml` points into `bytes`

  // Converts between the two kinds of offsets. A physical offset within a checksum becomes the end of all
  // bytes.
  std::uint64_t logical(std::uint64_t physical) const;
  std::uint64_t physical(std::uint64_t logical) const;
};

// Reads the header, checks all checksums, and copies the contents of the pages. Errors name the byte, or the
// page whose checksum differs.
Result<void> read_e57_pages(const Source& source, E57Pages& pages);

}  // namespace relievo::io
