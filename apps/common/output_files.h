// Writes files completely or not at all. Tested by tests/cli/files_test.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo::app {

// Checks the path of an output before the work for it begins. Errors: kind option if the path has none of the
// endings, such as ".stl" (an empty list accepts any), or names one of the files in `taken`; kind output if
// no file can be written there because the folder is missing or read-only, or because the path is a folder or
// a device.
Result<void> check_output(const std::string& path, const std::vector<std::string_view>& endings,
                          std::span<const std::string> taken = {});

// A finished file, not yet written.
struct OutputFile {
  std::string path;
  std::vector<std::byte> bytes;
};

// Each file is first written without a name or, where that is not possible, under a temporary name. When all
// are complete, each gets its own name, so a reader sees either the old file or the whole new one. If one
// file cannot be written completely, all old files stay as they were. Errors: kind output.
Result<void> write_files(std::span<const OutputFile> files);

}  // namespace relievo::app
