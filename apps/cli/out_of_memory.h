// Ends the program in order when there is no memory left. Tested by tests/cli/faults.
#pragma once

namespace relievo::app::cli {

// From now on the process ends in order when an allocation fails, in whatever thread: it removes its temporary files,
// prints one line that says how much memory was in use, and exits with code 1. Exceptions could not leave threads.
void exit_when_out_of_memory();

}  // namespace relievo::app::cli
