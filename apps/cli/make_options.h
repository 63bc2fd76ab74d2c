// The options of `make`, which `batch` has, too: for all scans, and as columns of its table.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/input_flags.h"
#include "relievo/option_table.h"

namespace relievo::app::cli {

// The options of a relief and of its files, as the user types them.
struct MakeOptions {
  OptionValues relief;
  InputTexts in;
  std::string base_image;
  std::string units = "mm";
  int heightmap_px = 1024, preview_px = 1200;
};

void add_make_options(CLI::App& command, MakeOptions& options);

// Adds a flag for a whole number within the range.
void add_number(CLI::App& command, const char* name, int& value, const CLI::Range& range, const char* help);

}  // namespace relievo::app::cli
