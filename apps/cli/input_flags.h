// The flags of the commands that read a scan, and what they stand for.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "common/read_inputs.h"
#include "relievo/option_texts.h"
#include "relievo/view_sample.h"

namespace relievo::app::cli {

// InputArguments as they are typed.
struct InputTexts {
  DepthTexts depth;
  std::string camera;
  double stream_above_mb = InputArguments{}.stream_above_mb;
};

void add_input_flags(CLI::App& command, InputTexts& texts);

// Returns what the texts ask for. Errors: those of parse_depth().
Result<InputArguments> parse_input_texts(const InputTexts& texts);

// The inputs of a command and the side of them to look at.
struct SceneArguments : ViewTexts {
  std::vector<std::string> paths;
  InputTexts in;
};

// Adds INPUT, the flags of ViewTexts and the flags of InputTexts.
void add_scene_flags(CLI::App& command, SceneArguments& arguments);

struct SampledView {
  ViewSample sample;
  View view;
};

// Reads the inputs and takes the points seen in their view, as `make` does. Errors: those of parse_input_texts(),
// parse_view(), read_scene() and sample_for_view().
Result<SampledView> read_sample(const SceneArguments& arguments, Progress* progress);

}  // namespace relievo::app::cli
