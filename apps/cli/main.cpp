#include <cstdio>
#include <iostream>
#include <string_view>

#include "cli/memory.h"
#include "cli/program.h"
#include "common/memory_reserve.h"
#include "common/temporary_file.h"

namespace {

// Returns whether all printed text has been written. Writing fails on a full disk, for example.
bool is_printed() {
  return std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  relievo::app::cli::restart_with_huge_pages(argv);
  // If the memory does not suffice for a request, the studio refuses the request and goes on. Other commands end.
  if (argc > 1 && argv[1] == std::string_view("studio"))
    relievo::app::keep_memory_in_reserve();
  else
    relievo::app::cli::exit_when_out_of_memory();
  relievo::app::remove_temporary_files_on_signals();
  const relievo::app::cli::ProgramEnd end = relievo::app::cli::run_program({argv + 1, argv + argc});
  if (!end.message.empty()) std::fprintf(stderr, "relievo: %s\n", end.message.c_str());
  if (end.exit_code != 0 || is_printed()) return end.exit_code;
  std::fprintf(stderr, "relievo: standard output: expected room to write what is printed\n");
  return 1;
}
