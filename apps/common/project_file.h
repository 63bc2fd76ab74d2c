// Project files on disk: JSON alone, or a ZIP archive of the JSON and the scan. Tested by
// apps/studio/tests/documents.test.mjs.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/project.h"

namespace relievo::app {

// The bytes of a scan that is part of a project file.
struct PackedScan {
  std::string name;  // without folders
  std::vector<std::byte> bytes;
};

struct ProjectFile {
  std::string text;                        // see read_project()
  std::shared_ptr<const PackedScan> scan;  // null if the project only names its scan
};

// Takes a project file apart, called `name` in errors. Errors: kind input, also for an archive without a project, or of
// more than 4 GiB.
Result<ProjectFile> unpack_project(std::span<const std::byte> bytes, std::string_view name);

// Returns a project file with the scan, compressed. Errors: kind output if the memory is not enough.
Result<std::vector<std::byte>> pack_project(std::string_view text, std::string_view scan_name,
                                            std::span<const std::byte> scan);

}  // namespace relievo::app
