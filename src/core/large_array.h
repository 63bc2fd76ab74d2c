// Storage for large arrays that are read from front to back. Tested by tests/solver/cholesky_test.cpp.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace relievo {

struct FreeArray {
  void operator()(float* array) const { std::free(array); }
};
using LargeArray = std::unique_ptr<float[], FreeArray>;

// Returns an uninitialised array of that many floats, aligned to 64 bytes or more. Large arrays are put on
// large pages if the system offers them, which makes reading from front to back up to 1.5 times as fast.
LargeArray make_large_array(std::size_t floats);

}  // namespace relievo
