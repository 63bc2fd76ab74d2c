// ZIP archives of a few deflated files.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace relievo::io {

class ZipWriter {
 public:
  // Deflates and appends a file. Dates are those of the format's beginning: same content, same bytes.
  void add(std::string_view name, std::string_view content);

  // Returns the archive; empty if a size exceeds what ZIP without its 64-bit extension can tell.
  std::vector<std::byte> finish();

 private:
  struct Entry {
    std::string_view name;  // literal
    std::size_t offset, packed_size, size;
    unsigned long crc;
  };
  void put(std::size_t value, int bytes);
  void put_common(const Entry& entry);

  std::vector<std::byte> out_;
  std::vector<Entry> entries_;
  bool is_too_large_ = false;
};

}  // namespace relievo::io
