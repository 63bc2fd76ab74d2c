// Orders for reliefs as Python and WebAssembly give them, and the reliefs that come of them.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/project_file.h"
#include "common/read_inputs.h"
#include "relievo/make_relief.h"
#include "relievo/picture/preview.h"

namespace relievo::app {

// Tells how to make a relief.
struct MakeOrder {
  OptionTexts texts;
  std::set<std::string> given;  // names of the options that are not left to their defaults
  InputArguments in;
  std::string base_image_path = {};
  std::string scan_path = {};  // of a project
  std::shared_ptr<const Image<float>> base_image = nullptr;
};

// Returns the options as values, those of a project included. Errors: those of parse_options() and take_base_image().
Result<ReliefOptions> options_of(const MakeOrder& order, const std::optional<Project>& project);

// The scene of an order, what was said about its files, and the options to make it by.
struct LoadedOrder {
  SceneInput input;
  ReliefOptions options;
  std::optional<Project> project = {};
};

// Returns the scene of an order: that of its project or, without one, what `read` returns. Errors: those of options_of(),
// load_project_scan() and `read`.
Result<LoadedOrder> load_order(const MakeOrder& order, const std::optional<StoredProject>& stored,
                               const std::function<Result<SceneInput>(const ReliefOptions&)>& read,
                               Progress& progress);

// Holds what a relief's report tells of its inputs, without the scans themselves.
struct InputFacts {
  std::vector<std::string> paths, remarks;  // paths: of files that must not be overwritten
  nlohmann::json models;
};

// Returns the facts of an order whose files have these paths.
InputFacts facts_of(const MakeOrder& order, std::vector<std::string> paths, const LoadedOrder& loaded);

// A relief that was made, and all that its files and its report need.
struct FinishedRelief {
  MadeRelief made;
  nlohmann::json report;
  std::vector<std::string> remarks, inputs;  // inputs: paths that must not be overwritten
  std::optional<double> draft_deg;
};

// Puts it together.
FinishedRelief finished(MadeRelief made, const InputFacts& facts, const ReliefOptions& options,
                        Progress& progress);

// Returns how to draw a relief. Errors: kind option for a size not in [1, 5461] and for unknown materials.
Result<PreviewOptions> preview_options(int longer_side_px, std::string_view material);

}  // namespace relievo::app
