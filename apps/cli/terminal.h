// Prints progress, warnings and errors of the command line.
#pragma once

#include <string>
#include <string_view>

#include "relievo/core/progress.h"

namespace relievo::app::cli {

// Returns a watcher that draws a progress bar with the names of stages on standard error, and erases it at
// the end. Returns an empty watcher if `is_quiet` or if standard error is not a terminal.
Progress::Watcher progress_bar(bool is_quiet);

// Returns the text with '?' in place of control characters, which words from files may contain. They could
// break the line or send commands to the terminal. Letters in UTF-8 stay as they are.
std::string on_one_line(std::string_view text);

}  // namespace relievo::app::cli
