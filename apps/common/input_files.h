// Finds the files that a relief is made from, without reading scans. `make` and Python overwrite none of them, and
// `batch` makes a relief anew when one of them has changed. Tested by tests/cli/input_files_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/make_order.h"

namespace relievo::app {

struct InputFile {
  std::string path;
  bool is_texture = false;  // whether it only colours a mesh
};

// Returns the file and the files to which it refers: the models of a scene; the scan, the base's height map and
// the options' files of a project; the buffers and images of a glTF file; the materials and textures of an OBJ
// file. Files that are packed in a project are left out; missing files are not. Of a file that is missing or
// cannot be parsed, only its own path is returned.
std::vector<InputFile> files_read_with(const std::string& path);

// Returns the files that the value of the option names; a list of ornaments names further files. Relative paths
// start at `folder`. Returns nothing if the value is not the path of a file.
std::vector<std::string> files_in_option(const std::string& option, const std::string& value,
                                         const std::string& folder = {});

// Returns the paths of the existing files that the order reads. Missing files are left out, because an output
// cannot overwrite them.
std::vector<std::string> paths_read_by(const MakeOrder& order);

// Returns whether the option accepts the path of a file and `value` is the path of an existing file.
bool is_path(const std::string& option, const std::string& value);

}  // namespace relievo::app
