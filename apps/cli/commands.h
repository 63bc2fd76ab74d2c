// Each function adds one subcommand to the program. When the user runs that subcommand, its outcome is stored
// in `result`.
#pragma once

#include <CLI/CLI.hpp>

#include "relievo/core/error.h"

namespace relievo::app::cli {

void add_make(CLI::App& program, Result<void>& result);
void add_info(CLI::App& program, Result<void>& result);
void add_sample(CLI::App& program, Result<void>& result);
void add_bench(CLI::App& program, Result<void>& result);
void add_studio(CLI::App& program, Result<void>& result);
void add_compare(CLI::App& program, Result<void>& result);
void add_batch(CLI::App& program, Result<void>& result);
void add_thumbnail(CLI::App& program, Result<void>& result);
void add_options(CLI::App& program, Result<void>& result);

}  // namespace relievo::app::cli
