// Makes the system give this program memory in pages of 2 MB instead of 4 KB.
#pragma once

namespace relievo::app::cli {

// Starts the program anew, once, with the request for huge pages in its environment: glibc reads the request
// only there and only before main(). Returns if a restart is impossible or was already made. A user's own
// GLIBC_TUNABLES stays as it is.
void restart_with_huge_pages(char** argv);

}  // namespace relievo::app::cli
