// Progress, warnings and errors as the command line prints them.
#pragma once

#include <string>

#include "relievo/core/progress.h"

namespace relievo::app::cli {

// A progress bar with stage names on standard error if that is a terminal, else nothing. Erased at the end.
Progress::Watcher progress_bar(bool is_quiet);

}  // namespace relievo::app::cli
