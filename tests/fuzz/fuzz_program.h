// Makes a program from a fuzz target. With clang and -DRELIEVO_FUZZ=ON, libFuzzer drives the target.
// Otherwise the program runs the target over the files on its command line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

#ifdef RELIEVO_LIBFUZZER
#define RELIEVO_RUN_FILES
#else
#define RELIEVO_RUN_FILES                                                                      \
  int main(int argc, char** argv) {                                                            \
    for (int i = 1; i < argc; ++i) {                                                           \
      std::ifstream file(argv[i], std::ios::binary);                                           \
      const std::string text{std::istreambuf_iterator<char>(file), {}};                        \
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()); \
    }                                                                                          \
    return 0;                                                                                  \
  }
#endif
