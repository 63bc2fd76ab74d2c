// Runs the whole program as a function of its arguments.
#pragma once

#include <string>
#include <vector>

namespace relievo::app::cli {

struct ProgramEnd {
  int exit_code = 0;         // 1 for bad input or output, 2 for misuse
  std::string message;       // one line about an error; empty without one
  bool may_succeed = false;  // whether the same call may succeed another time: memory or a disk was full
};

// Parses the arguments, which follow the program's name, and does what they ask for.
ProgramEnd run_program(std::vector<std::string> arguments);

}  // namespace relievo::app::cli
