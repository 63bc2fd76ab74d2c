// Files of the command line: whole ones in, whole ones out.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app {

// Returns the bytes of a file. Errors: kind input, telling why it cannot be read; also for folders, devices, files larger
// than half of the memory and, unless `is_pipe_fine`, pipes.
Result<std::vector<std::byte>> read_file(const std::string& path, bool is_pipe_fine = false);

// Checks the path of an output before the work for it begins. Errors: kind option if it has none of the endings,
// given as ".stl" (any will do if there are none), or leads to one of the files in `taken`; kind output if no file
// could be written there: folder missing or read-only, or the path is a folder or a device.
Result<void> check_output(const std::string& path, const std::vector<std::string_view>& endings,
                          std::span<const std::string> taken = {});

// A finished file, not yet written.
struct OutputFile {
  std::string path;
  std::vector<std::byte> bytes;
};

// Writes all files (at most 8) to temporary names in their folders and, when all are complete, renames them:
// readers see an old file or the whole new one, and if one cannot be written, all stay as they were. Errors:
// kind output.
Result<void> write_files(std::span<const OutputFile> files);

// Returns the text as the content of a file.
std::vector<std::byte> bytes_of(std::string_view text);

// Returns the path's ending in lower case, without the dot.
std::string ending_of(const std::string& path);

}  // namespace relievo::app
