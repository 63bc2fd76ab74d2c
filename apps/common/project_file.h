// Reads and writes project files: only JSON, or a ZIP archive of the JSON and the scan. Tested by
// apps/studio/tests/documents.test.mjs and python/tests/test_make.py.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/project.h"

namespace relievo::app {

// The bytes of a scan, or of the height map of a base, that is part of a project file.
struct PackedFile {
  std::string name;  // without folders
  std::vector<std::byte> bytes;
};

struct ProjectFile {
  std::string text;                                    // see read_project()
  std::shared_ptr<const PackedFile> scan, base_image;  // null if the project only names the file, or has none
};

// Unpacks a project file, called `name` in errors. Errors: kind input, also for an archive without a project,
// or of more than 4 GiB.
Result<ProjectFile> unpack_project(std::span<const std::byte> bytes, std::string_view name);

// Returns the bytes of a compressed project file with the scan and, unless it is null, the height map of the
// base. Errors: kind output if the memory is not enough.
Result<std::vector<std::byte>> pack_project(std::string_view text, const PackedFile& scan,
                                            const PackedFile* base_image);

// A project that was read, and where its scan is.
struct StoredProject {
  Project project;
  std::string folder;                        // folder of the project's file
  std::shared_ptr<const PackedFile> packed;  // null unless the file contains the scan
  std::string located;                       // path of the scan that the user gives instead; may be empty
};

// Returns the project if the inputs are a single project file; nothing otherwise. `located` becomes
// StoredProject::located. Errors: those of read_file(), unpack_project() and read_project(); kind option if
// `located` is given without a project.
Result<std::optional<StoredProject>> find_project(const std::vector<std::string>& inputs,
                                                  const std::string& located);

// Returns the height map in the file at the given path. If no path is given and the base is an image, returns
// the project's height map. Null if there is none. Errors: those of read_base_image().
Result<std::shared_ptr<const Image<float>>> base_image_for(const BaseOptions& base,
                                                           const std::string& given_path,
                                                           const std::optional<Project>& project);

// Reads the project's scan: from the path that the user gives, from the project's file, or from the path that
// the project names. Errors: those of load_scan() and load_input().
Result<Scene> load_project_scan(const StoredProject& stored, const LoadOptions& options);

}  // namespace relievo::app
