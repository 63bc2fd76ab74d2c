// Makes reliefs from the orders that the command line, Python and WebAssembly give.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/project_file.h"
#include "common/read_inputs.h"
#include "relievo/core/length.h"
#include "relievo/core/progress.h"
#include "relievo/make_relief.h"
#include "relievo/picture/preview.h"

namespace relievo::app {

// Describes a relief to make.
struct MakeOrder {
  OptionValues values;                   // includes the options of depth images
  InputArguments input_arguments;        // check_order() sets the fields for which `values` has options
  std::vector<std::string> inputs = {};  // paths
  std::string base_image_path = {};
  std::string scan_path = {};  // path of a project's scan
  std::shared_ptr<const Image<float>> base_image = nullptr;
  // If set, this function is called instead of read_scene(), because some inputs are not files. `name` is then the
  // name of all inputs together.
  std::function<Result<Scene>(const InputArguments&, const PointsWanted&, Progress*)> read = {};
  std::string name = {};
  std::vector<std::string> unset = {};       // options of a prepared model that this order does not use
  std::vector<std::string> paths_read = {};  // no output may overwrite these files; see paths_read_by()
};

// Returns whether the order has a height map for the base.
inline bool has_height_map(const MakeOrder& order) {
  return order.base_image || !order.base_image_path.empty();
}

// Returns whether the options state the base `image`, which needs a height map.
bool has_image_base(const OptionValues& values);

// Returns the options `own`, overridden by those of the order, see with_given(). A base's height map in the order
// sets the base `image`, unless the order states a base.
OptionValues overridden(OptionValues own, const MakeOrder& order);

// Parses the options of an order and those of its project, if it has one. Errors: those of parse_options()
// and take_base_image().
Result<ReliefOptions> options_of(const MakeOrder& order, const std::optional<StoredProject>& project);

// An order whose options are parsed, with its project if its input is a project.
struct CheckedOrder : MakeOrder {
  std::optional<StoredProject> project;
  ReliefOptions options;
};

// Reads the project if the input is a project, and parses the options. Errors: those of find_project() and
// options_of().
Result<CheckedOrder> check_order(MakeOrder order);

// An order with its inputs read and its view chosen.
struct LoadedOrder : CheckedOrder {
  Scene scene;
  std::optional<ViewGuess> side;  // the automatically chosen side; empty if the options set the view
};

// Reads the inputs and chooses the view. Errors: kind option if there is no input; those of
// load_project_scan(), read_scene() and `read`.
Result<LoadedOrder> load(CheckedOrder order, Progress& progress);

// The facts about a relief's inputs that its report states. They are copies, so the scans can be freed.
struct InputFacts {
  std::string name;
  std::vector<std::string> paths_read, remarks;  // paths_read: files that must not be overwritten
  nlohmann::json models;
  std::vector<std::string> left_out =
      {};  // the remarks on parts of a cloud or mesh that were left out; also in `remarks`
};

InputFacts facts_of(const LoadedOrder& loaded);

// Returns the models of the scene and their positions: a point p of a file is at scale * rotation * p +
// offset in the scene.
nlohmann::json models_report(const Scene& scene, const View& view);

// A finished relief, with all that its files and its report need.
struct FinishedRelief {
  MadeRelief made;
  InputFacts inputs;
  std::optional<double> draft_deg;
  std::vector<StageTime> times = {};  // durations of the stages; empty before end()
  nlohmann::json kept_report = {};    // the report of a relief that was read from a file; else null

  // Ends the progress, and stores the durations of its stages in `times`.
  void end(Progress& progress);

  // Returns the remarks on the inputs and on the relief.
  std::vector<std::string> remarks() const;

  // Returns the report. All its lengths are in millimetres. The report also names `unit`, the unit of the
  // relief's files.
  nlohmann::json report(LengthUnit unit = LengthUnit::mm) const;
};

// Makes the relief. The caller must then call end(). Errors: those of make_relief(); they also name the inputs.
Result<FinishedRelief> make(LoadedOrder loaded, Progress& progress);

// Calls check_order(), load() and make() in turn. Errors: those of the three functions.
Result<std::shared_ptr<FinishedRelief>> make(MakeOrder order, Progress& progress);

// Returns options for drawing a relief. Errors: kind option for a size not in [1, 5461] and for unknown
// materials.
Result<PreviewOptions> preview_options(int longer_side_px, std::string_view material);

}  // namespace relievo::app
