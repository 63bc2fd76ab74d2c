// Storage for the factor: one large array that is read from front to back.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace relievo {

struct FreeArray {
  void operator()(float* array) const { std::free(array); }
};
using LargeArray = std::unique_ptr<float[], FreeArray>;

// Returns an array that is not initialised, on large pages where the system offers them: reading it front to
// back is then up to half as fast again.
LargeArray make_large_array(std::size_t floats);

}  // namespace relievo
