// Memory accounting.
#pragma once

#include <cstddef>
#include <vector>

namespace relievo {

// Returns the bytes that a vector has allocated, not counting what its elements own.
template <typename T>
std::size_t bytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

}  // namespace relievo
