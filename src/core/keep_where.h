// Removes elements of lists. Tested by tests/io/io_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

namespace relievo {

// Keeps the elements values[i] for which is_kept(i) holds, in their order. Calls is_kept() once for each i,
// from 0 upwards.
template <typename T, typename IsKept>
void keep_where(std::vector<T>& values, IsKept&& is_kept) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_kept(i)) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace relievo
