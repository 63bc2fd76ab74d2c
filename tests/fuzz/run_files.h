// Runs a fuzz target over files.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

// Calls run(contents) for each file named on the command line.
template <typename Run>
int run_files(int argc, char** argv, Run&& run) {
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    run(std::string{std::istreambuf_iterator<char>(file), {}});
  }
  return 0;
}
