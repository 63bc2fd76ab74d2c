// Files of the command line: whole ones in, whole ones out.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app {

// Returns the bytes of a file. Errors: kind input, telling why it cannot be read.
Result<std::vector<std::byte>> read_file(const std::string& path);

// Fails if a file of that path could not be written later: folder missing or read-only, or the path is a
// folder or a device.
Result<void> check_writable(const std::string& path);

// Returns whether both paths lead to the same file, which need not exist.
bool is_same_file(const std::string& a, const std::string& b);

// A finished file, not yet written.
struct OutputFile {
  std::string path;
  std::vector<std::byte> bytes;
};

// Writes all files (at most 8) to temporary names in their folders and, when all are complete, renames them:
// readers see an old file or the whole new one, and if one cannot be written, all stay as they were. Errors:
// kind output.
Result<void> write_files(std::span<const OutputFile> files);

// From now on Ctrl-C and other signals that end the program remove its temporary files first.
void remove_temporary_files_on_signals();

// The path's ending in lower case, without the dot.
std::string ending_of(const std::string& path);

}  // namespace relievo::app
