// Requests memory in huge pages, and ends the program when no memory is left. Tested by tests/cli/faults.
#pragma once

namespace relievo::app::cli {

// Makes the system give this program memory in pages of 2 MB instead of 4 KB, which makes memory access faster. Restarts
// the program once, with the request for huge pages in an environment variable: glibc reads the variable only before
// main(). Returns if a restart is impossible or has already happened. If the user has set GLIBC_TUNABLES, it stays
// unchanged.
void restart_with_huge_pages(char** argv);

// After this call, if an allocation fails in any thread, the process removes its temporary files, prints one line
// with the amount of memory in use, and exits with code 1. An exception could not do this, as it cannot pass from
// one thread to another.
void exit_when_out_of_memory();

}  // namespace relievo::app::cli
