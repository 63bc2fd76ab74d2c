// Makes a program from a fuzz target. With clang and -DRELIEVO_FUZZ=ON, libFuzzer drives the target.
// Otherwise the program runs the target over the files on its command line.
#pragma once

#include <string_view>

// Runs the target over one input. Each target defines this function.
void run_target(std::string_view input);
