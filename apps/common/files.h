// Reads files, and takes endings from paths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app {

// Returns the bytes of a file. Errors: kind input, with the reason, if the file cannot be read, if it is
// larger than half of the memory, and if the path is that of a folder or a device. A pipe is an error, too,
// unless `is_pipe_fine`.
Result<std::vector<std::byte>> read_file(const std::string& path, bool is_pipe_fine = false);

// Returns whether a file, a folder or a device has that path.
bool is_there(const std::string& path);

// Returns the path if it is absolute; otherwise appends it to the folder.
std::string path_in(const std::string& folder, const std::string& path);

// Checks that the path is missing or is that of a regular file. Errors: kind input.
Result<void> check_file(const std::string& path);

// Returns the time of the last change of a file in ns since 1970; 0 for a missing file.
std::int64_t time_of_change_ns(const std::string& path);

// Returns the size of a regular file in bytes. Returns nothing for all other paths.
std::optional<std::uint64_t> file_size(const std::string& path);

// Returns the bytes of the text, as the content of a file.
std::vector<std::byte> bytes_of(std::string_view text);

// Returns a view of the bytes as text. The view is valid as long as the bytes are.
inline std::string_view text_in(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Returns the text of a file; an empty text if the file cannot be read.
inline std::string text_of_file(const std::string& path) {
  const auto bytes = read_file(path);
  return std::string(bytes ? text_in(*bytes) : std::string_view());
}

// Returns the value of a variable of the environment; "" if it is not set.
std::string environment_variable(const char* name);

// Returns the path's ending in lower case, without the dot.
std::string ending_of(const std::string& path);

}  // namespace relievo::app
