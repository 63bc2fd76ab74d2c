// Makes the system give this program memory in pages of 2 MB instead of 4 KB. Fewer pages make memory access
// faster.
#pragma once

namespace relievo::app::cli {

// Restarts the program once, with the request for huge pages in an environment variable. The restart is
// needed because glibc reads this variable only before main(). Returns if a restart is impossible or has
// already happened. If the user has set GLIBC_TUNABLES, it stays unchanged.
void restart_with_huge_pages(char** argv);

}  // namespace relievo::app::cli
