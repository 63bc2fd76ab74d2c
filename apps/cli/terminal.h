// Progress, warnings and errors as the command line prints them.
#pragma once

#include <string>
#include <string_view>

#include "relievo/core/progress.h"

namespace relievo::app::cli {

// A progress bar with stage names on standard error if that is a terminal, else nothing. The bar is erased at
// the end.
Progress::Watcher progress_bar(bool is_quiet);

// Returns the text with '?' in place of control characters, which names and words from files may contain. So
// the text stays on one line and cannot command the terminal. Letters in UTF-8 are kept.
std::string on_one_line(std::string_view text);

}  // namespace relievo::app::cli
