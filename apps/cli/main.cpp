#include <cstdio>
#include <string_view>

#include "cli/out_of_memory.h"
#include "cli/program.h"
#include "common/temporary_file.h"

int main(int argc, char** argv) {
  // The studio refuses what is too large, and goes on.
  if (argc > 1 && argv[1] != std::string_view("studio")) relievo::app::cli::exit_when_out_of_memory();
  relievo::app::remove_temporary_files_on_signals();
  const relievo::app::cli::ProgramEnd end = relievo::app::cli::run_program({argv + 1, argv + argc});
  if (!end.message.empty()) std::fprintf(stderr, "relievo: %s\n", end.message.c_str());
  return end.exit_code;
}
