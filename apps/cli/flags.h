// Adds flags to a command, from the rows of the table of options.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "relievo/option_table.h"

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

}  // namespace relievo::app::cli
