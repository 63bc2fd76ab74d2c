#include "fuzz/fuzz_program.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  run_target({reinterpret_cast<const char*>(data), size});
  return 0;
}

#ifndef RELIEVO_LIBFUZZER
int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    run_target(std::string{std::istreambuf_iterator<char>(file), {}});
  }
  return 0;
}
#endif
