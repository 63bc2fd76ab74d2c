// Files of the command line: whole ones in, whole ones out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "relievo/error.h"

namespace relievo::cli {

// Returns the bytes of a file. Errors: kind input, telling why it cannot be read.
Result<std::vector<std::byte>> read_file(const std::string& path);

// Fails if a file of that path could not be written later: folder missing or read-only, or the path a folder.
Result<void> check_writable(const std::string& path);

// Writes to a temporary name in the same folder, then renames: readers see the old file or the whole new one,
// and after an error nothing is left. Errors: kind output.
Result<void> write_file(const std::string& path, std::span<const std::byte> bytes);

// The path's ending in lower case, without the dot.
std::string ending_of(const std::string& path);

}  // namespace relievo::cli
