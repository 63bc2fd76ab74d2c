// Ends the program in order when there is no memory left. Tested by tests/cli/faults.
#pragma once

namespace relievo::app::cli {

// From now on, if an allocation fails in any thread, the process removes its temporary files, prints one line
// that says how much memory was in use, and exits with code 1. An exception would not do, as it cannot leave
// its thread.
void exit_when_out_of_memory();

}  // namespace relievo::app::cli
