// Defines the options of `make`. `batch` has the same options, as flags for all scans and as columns of its
// table.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/input_flags.h"
#include "common/make_order.h"
#include "common/relief_files.h"

namespace relievo::app::cli {

// The options of a relief and of its files, as the user types them.
struct MakeOptions {
  MakeOrder order;
  InputTexts in;
  ReliefFiles files;
  std::string units = "mm";
};

void add_make_options(CLI::App& command, MakeOptions& options);

}  // namespace relievo::app::cli
