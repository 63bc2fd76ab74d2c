// Decodes columns of binary numbers to double.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>

namespace relievo::io {

enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_in_bytes(NumberType type);

// Returns the whole number from 0 to 255 that is nearest to the value; 0 for a NaN.
std::uint8_t as_byte(double value);

// Decodes `rows` values that are `stride` bytes apart.
using Decode = void (*)(const char* first, std::size_t stride, std::size_t rows, double* values);

Decode decoder(NumberType type, bool is_big_endian);

// Returns the number of type T at `from`, which need not be aligned, in the machine's byte order or in the
// opposite one.
template <typename T, bool is_swapped>
T number_at(const char* from) {
  using Sizes = std::tuple<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>;
  std::tuple_element_t<std::countr_zero(sizeof(T)), Sizes> bits;
  std::memcpy(&bits, from, sizeof bits);
  if constexpr (is_swapped) bits = std::byteswap(bits);
  return std::bit_cast<T>(bits);
}

// Returns the little-endian number of type T at `from`.
template <typename T>
T little(const char* from) {
  return number_at<T, std::endian::native == std::endian::big>(from);
}

}  // namespace relievo::io
