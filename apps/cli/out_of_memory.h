// Ends the program cleanly when there is no memory left. Tested by tests/cli/faults.
#pragma once

namespace relievo::app::cli {

// After this call, if an allocation fails in any thread, the process removes its temporary files, prints one line
// with the amount of memory in use, and exits with code 1. An exception could not do this, as it cannot pass from
// one thread to another.
void exit_when_out_of_memory();

}  // namespace relievo::app::cli
