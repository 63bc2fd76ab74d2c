// Prints progress, warnings and errors as the command line shows them.
#pragma once

#include <string>
#include <string_view>

#include "relievo/core/progress.h"

namespace relievo::app::cli {

// Returns a watcher that draws a progress bar with stage names on standard error, and erases it at the end.
// Returns nothing if `is_quiet` or if standard error is not a terminal.
Progress::Watcher progress_bar(bool is_quiet);

// Returns the text with '?' in place of control characters, which names and words from files may contain. So
// the text stays on one line and cannot command the terminal. Letters in UTF-8 are kept.
std::string on_one_line(std::string_view text);

}  // namespace relievo::app::cli
