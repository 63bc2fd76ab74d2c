// Adds the flags of the commands that read a scan.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "common/read_inputs.h"
#include "relievo/option_table.h"
#include "relievo/view_sample.h"

namespace relievo::app::cli {

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

}  // namespace relievo::app::cli
