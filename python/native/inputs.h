// Reads what Python makes a relief of: paths, bytes of files, arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/project_file.h"
#include "common/read_inputs.h"

namespace relievo::python {

// The content of a file, called `name`; Python's object, which does not change, keeps the bytes.
struct FileBytes {
  pybind11::bytes object;
  std::string name;
  std::span<const std::byte> bytes;
};

// A model from arrays: of points and triangles, or of depths.
struct ArrayModel {
  std::string name;
  std::shared_ptr<const CloudFile> file;  // null for depths
  std::shared_ptr<const DepthImage> depths;
};

// One model, or a scene or a project by its path.
using Source = std::variant<std::string, FileBytes, ArrayModel>;

// Returns the sources of a list of texts, (bytes, name) tuples and models that array_model() and depth_model() made.
std::vector<Source> sources_of(const pybind11::list& list);

// Returns the names of the sources, and their paths.
std::string names_of(const std::vector<Source>& sources);
std::vector<std::string> paths_of(const std::vector<Source>& sources);

// Returns the project that the sources are, if they are one alone. Errors: those of app::find_project().
Result<std::optional<app::StoredProject>> find_project(const std::vector<Source>& sources,
                                                       const std::string& located);

// Reads the sources, as `relievo make` reads its inputs. Errors: those of read_scene() and parse_input().
Result<app::SceneInput> read_sources(const std::vector<Source>& sources, const app::InputArguments& arguments,
                                     const app::PointsWanted& wanted, Progress* progress);

void add_inputs(pybind11::module_& module);

}  // namespace relievo::python
