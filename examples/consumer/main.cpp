// A program that uses the installed library: my_program SCAN RELIEF.stl. It is built together with
// relief_of.cpp.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "relievo/core/error.h"

relievo::Result<std::vector<std::byte>> relief_of(std::span<const std::byte> scan);

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "Usage: my_program SCAN RELIEF.stl\n");
    return 2;
  }
  std::ifstream file(argv[1], std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "my_program: %s: expected a file that can be read\n", argv[1]);
    return 1;
  }
  const std::vector<char> scan{std::istreambuf_iterator<char>(file), {}};
  const auto stl = relief_of(std::as_bytes(std::span(scan)));
  if (!stl) {
    std::fprintf(stderr, "my_program: %s\n", stl.error().message().c_str());
    return 1;
  }
  std::ofstream out(argv[2], std::ios::binary);
  out.write(reinterpret_cast<const char*>(stl->data()), static_cast<std::streamsize>(stl->size()));
  return out ? 0 : 1;
}
