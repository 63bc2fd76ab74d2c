// Makes reliefs, as `relievo make` does, and keeps them.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "native/inputs.h"
#include "relievo/make_relief.h"

namespace relievo::python {

// What to make, from Python's objects: the sources and a dict of keywords.
struct MakeOrder {
  std::vector<Source> sources;
  OptionTexts texts;
  std::set<std::string> given;  // names of the options that are not left to their defaults
  app::InputArguments in;
  std::string base_image_path, scan_path;  // scan_path: of a project
  std::shared_ptr<const Image<float>> base_image;
};

// Reads the arguments. Raises TypeError or relievo.Error for those of a wrong type.
MakeOrder order_of(const pybind11::list& sources, const pybind11::dict& keywords);

// Returns the options as values, those of a project included. Errors: those of parse_options() and take_base_image().
Result<ReliefOptions> options_of(const MakeOrder& order, const std::optional<app::Project>& project);

// The scene of an order, what was said about its files, and the options to make it by.
struct Loaded {
  app::SceneInput input;
  ReliefOptions options;
  std::optional<app::Project> project = {};  // that gives options, too
};
Result<Loaded> load(const MakeOrder& order, Progress& progress);

// A relief that was made, and all that its files and its report need.
struct FinishedRelief {
  MadeRelief made;
  nlohmann::json report;
  std::vector<std::string> remarks, inputs;  // inputs: paths that must not be overwritten
  std::optional<double> draft_deg;
};

using SharedRelief = std::shared_ptr<FinishedRelief>;

// What the inputs of a relief leave behind, without Python's objects and without the scans themselves.
struct InputFacts {
  std::vector<std::string> paths, remarks;
  nlohmann::json models;
};
InputFacts facts_of(const MakeOrder& order, const Loaded& loaded);

// Puts it together.
SharedRelief finished(MadeRelief made, const InputFacts& facts, const ReliefOptions& options,
                      Progress& progress);

void add_relief(pybind11::module_& module);

}  // namespace relievo::python
