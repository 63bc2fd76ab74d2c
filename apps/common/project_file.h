// Reads and writes project files. Such a file is either JSON alone or a ZIP archive of the JSON and the scan.
// Tested by apps/studio/tests/documents.test.mjs and python/tests/test_make.py.
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

// A file within a project file: a scan, or the height map of a base.
struct PackedFile {
  std::string name;  // without folders
  std::vector<std::byte> bytes;
};

struct ProjectFile {
  std::string text;                                    // see read_project()
  std::shared_ptr<const PackedFile> scan, base_image;  // each is null if the project file does not contain it
  OrnamentFiles ornaments = {};                        // fonts and drawings
};

// Unpacks the bytes of a project file. Error messages call it `name`. Errors: kind input, also for an archive
// that has no project or is larger than 4 GiB.
Result<ProjectFile> unpack_project(std::span<const std::byte> bytes, std::string_view name);

// The JSON text of a project file, and which files it contains.
struct ProjectListing {
  std::string text;  // see read_project()
  bool has_scan = false, has_base_image = false;
};

// Does the same as unpack_project(), but unpacks the text alone.
Result<ProjectListing> list_project(std::span<const std::byte> bytes, std::string_view name);

// Returns the bytes of a compressed project file that contains the files of `file`. Errors: kind output if there
// is not enough memory.
Result<std::vector<std::byte>> pack_project(const ProjectFile& file);

// Returns the fonts and drawings that the options `font` and `ornaments` name, and replaces their paths by
// their names in a project file. Either option may be null. If `ornaments` is the path of a list, the text of
// the list replaces it. Errors: those of read_file() and parse_ornaments(); kind option if the file of a font
// contains no font.
Result<OrnamentFiles> pack_ornaments(std::string* font, std::string* ornaments);

// A project that was read, and the location of its scan.
struct StoredProject {
  Project project;
  std::string folder;                        // folder of the project's file
  std::shared_ptr<const PackedFile> packed;  // null unless the file contains the scan
  std::string located;                       // path that the user gives for the scan; empty if not given
  OrnamentFiles ornaments = {};              // the fonts and drawings in the project's file
};

// Returns the project if the inputs are a single project file; nothing otherwise. `located` becomes
// StoredProject::located. Errors: those of read_file(), unpack_project() and read_project(); kind option if
// `located` is given without a project.
Result<std::optional<StoredProject>> find_project(const std::vector<std::string>& inputs,
                                                  const std::string& located);

// Returns the height map in the file at the given path. If no path is given and the base is an image, returns
// the project's height map, or null if the project has none. Errors: those of read_base_image().
Result<std::shared_ptr<const Image<float>>> base_image_for(const BaseOptions& base,
                                                           const std::string& given_path,
                                                           const std::optional<Project>& project);

// Reads the project's scan from the first of these that is set: the path that the user gives, the project's
// own file, the path that the project names. Errors: those of load_scan() and load_input().
Result<Scene> load_project_scan(const StoredProject& stored, const LoadOptions& options);

}  // namespace relievo::app
