// Runs the whole program as a function of its arguments, for tests and for the jobs of a batch.
#pragma once

#include <string>
#include <vector>

namespace relievo::app::cli {

struct ProgramEnd {
  int exit_code = 0;         // 1 for bad input or output, 2 for misuse
  std::string message;       // one line about the error; empty if there is none
  bool may_succeed = false;  // whether the same call may succeed later, because memory or a disk was full
};

// Parses the arguments, without the program's name, and runs the command that they name.
ProgramEnd run_program(std::vector<std::string> arguments);

}  // namespace relievo::app::cli
