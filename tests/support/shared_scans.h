// Finds scans that are not part of the project, because their licences do not allow it. If a scan is missing,
// the test that needs it is skipped, with a message.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

namespace relievo::test {

// Returns the folder of scans. It is the environment variable RELIEVO_SHARED_DATA or, if this is not set, the
// CMake variable of this name.
inline std::filesystem::path shared_data() {
  if (const char* folder = std::getenv("RELIEVO_SHARED_DATA")) return folder;
  return RELIEVO_SHARED_DATA;
}

inline bool has_shared(const std::filesystem::path& name) {
  return std::filesystem::exists(shared_data() / name);
}

// Returns the bytes of a file in the folder of scans; no bytes if the file is missing.
inline std::vector<std::byte> shared_bytes(const std::filesystem::path& name) {
  std::ifstream file(shared_data() / name, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// Returns the message of a test that is skipped because the scan `name` is missing.
inline std::string missing_scan(const std::string& name) {
  return "not tested: " + (shared_data() / name).string() +
         " is missing. Set the environment variable RELIEVO_SHARED_DATA, or configure with "
         "-DRELIEVO_SHARED_DATA=FOLDER, to say where the scans are.";
}

}  // namespace relievo::test
