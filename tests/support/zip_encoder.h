// Writes ZIP archives for tests.
#pragma once

#include <zlib.h>

#include <utility>

#include "support/format_samples.h"

namespace relievo {

// Returns a ZIP archive of uncompressed files. Each file is given as its name and its content.
inline std::string archive_of(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string all, directory;
  for (const auto& [name, content] : files) {
    const auto checksum = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
    const auto size = static_cast<std::uint32_t>(content.size());
    const std::string facts = raw(std::uint16_t{20}) + std::string(8, '\0') + raw(checksum) + raw(size) +
                              raw(size) + raw(static_cast<std::uint16_t>(name.size())) +
                              raw(std::uint16_t{0});
    directory += "PK\x01\x02" + raw(std::uint16_t{20}) + facts + std::string(10, '\0') +
                 raw(static_cast<std::uint32_t>(all.size())) + name;
    all += "PK\x03\x04" + facts + name + content;
  }
  const auto count = static_cast<std::uint16_t>(files.size());
  return all + directory + "PK\x05\x06" + std::string(4, '\0') + raw(count) + raw(count) +
         raw(static_cast<std::uint32_t>(directory.size())) + raw(static_cast<std::uint32_t>(all.size())) +
         raw(std::uint16_t{0});
}

}  // namespace relievo
