// Adds flags to a command: flags for rows of the option table, the flags of commands that read a scan, and
// the flags of commands that make a relief.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "common/make_order.h"
#include "common/read_inputs.h"
#include "common/relief_files.h"
#include "relievo/option_table.h"
#include "relievo/view_sample.h"

namespace relievo::app::cli {

// Returns the help of an option with its range and its default. Omits a default that CLI11 prints itself.
std::string flag_help(const OptionRow& option);

// Adds one flag for each row of the table for which is_wanted() returns true. The values that the user gives
// are stored in `values`, which must outlive the command.
void add_flags(CLI::App& command, OptionValues& values,
               const std::function<bool(const OptionRow&)>& is_wanted,
               const std::function<std::string(const OptionRow&)>& help = flag_help);

// Adds a flag for an integer within the range.
void add_number(CLI::App& command, const char* name, int& value, const CLI::Range& range, const char* help);

// The values of InputArguments as the user types them.
struct InputTexts {
  OptionValues depth;
  double stream_above_mb = InputArguments{}.stream_above_mb;
};

void add_input_flags(CLI::App& command, InputTexts& texts);

// Parses the texts. Errors: those of parse_depth().
Result<InputArguments> parse_input_texts(const InputTexts& texts);

// The inputs of a command, and the view in which they are seen.
struct SceneArguments {
  std::vector<std::string> paths;
  OptionValues view;
  InputTexts in;
};

// Adds the argument INPUT, the flags of the view and the flags of InputTexts.
void add_scene_flags(CLI::App& command, SceneArguments& arguments);

struct SampledView {
  ViewSample sample;
  View view;
};

// Reads the inputs and returns the points that their view shows, as `make` does. Errors: those of
// parse_input_texts(), parse_options(), read_scene() and sample_for_view().
Result<SampledView> read_sample(const SceneArguments& arguments, Progress* progress);

// The options of a relief and of its files, as the user types them. `batch` has the same options as `make`:
// as flags for all scans, and as columns of its table.
struct MakeOptions {
  MakeOrder order;
  InputTexts in;
  ReliefFiles files;
  std::string units = "mm";
};

void add_make_options(CLI::App& command, MakeOptions& options);

}  // namespace relievo::app::cli
