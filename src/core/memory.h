// How much memory things hold.
#pragma once

#include <cstddef>
#include <vector>

namespace relievo {

template <typename T>
std::size_t bytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

}  // namespace relievo
