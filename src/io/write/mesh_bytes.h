// Writes numbers as little-endian bytes, for all mesh writers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace relievo::detail {

// Writes the bytes of a number and returns the address after them.
template <typename T>
std::byte* put(std::byte* to, T value) {
  static_assert(std::endian::native == std::endian::little, "the files are little-endian");
  std::memcpy(to, &value, sizeof value);
  return to + sizeof value;
}

template <typename Vector>
std::byte* put_vector(std::byte* to, const Vector& vector) {
  for (const auto value : vector) to = put(to, value);
  return to;
}

inline std::byte* put_text(std::byte* to, std::string_view text) {
  std::memcpy(to, text.data(), text.size());
  return to + text.size();
}

}  // namespace relievo::detail
