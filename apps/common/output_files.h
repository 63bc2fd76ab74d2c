// Writes files completely or not at all. Tested by tests/cli/files_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app {

// Checks the path of an output before the work for it begins. `endings` lists the allowed endings, such as ".stl";
// an empty list allows any. Errors: kind option if the path has another ending or names one of the files in `taken`;
// kind output if the folder is missing or read-only, or if the path is a folder or a device.
Result<void> check_output(const std::string& path, const std::vector<std::string_view>& endings,
                          std::span<const std::string> taken = {});

// A finished file, not yet written.
struct OutputFile {
  std::string path;
  std::vector<std::byte> bytes;
};

// Writes all files. Each file is first written without a name or, where that is not possible, under a temporary
// name. When all are complete, each gets its final name, so a reader sees either the old file or the whole new one.
// If one file cannot be written completely, all old files stay as they were. Errors: kind output.
Result<void> write_files(std::span<const OutputFile> files);

}  // namespace relievo::app
