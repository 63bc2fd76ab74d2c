// Decodes columns of binary numbers to double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace relievo::io {

enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_in_bytes(NumberType type);

// Decodes `rows` values that are `stride` bytes apart.
using Decode = void (*)(const char* first, std::size_t stride, std::size_t rows, double* values);

Decode decoder(NumberType type, bool is_big_endian);

// Returns the little-endian number of type T at `from`, which need not be aligned.
template <typename T>
T little(const char* from) {
  static_assert(sizeof(T) <= 8);
  std::uint64_t bits = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(from[i]);
  T value;
  if constexpr (sizeof(T) == 8) {
    std::memcpy(&value, &bits, 8);
  } else {
    const auto low = static_cast<std::uint32_t>(bits);
    if constexpr (sizeof(T) == 4)
      std::memcpy(&value, &low, 4);
    else
      value = static_cast<T>(low);
  }
  return value;
}

}  // namespace relievo::io
