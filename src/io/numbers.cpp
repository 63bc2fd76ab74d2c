#include "io/numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::io {
namespace {

template <typename T, bool is_swapped>
void decode(const char* first, std::size_t stride, std::size_t rows, double* values) {
  for (std::size_t i = 0; i < rows; ++i)
    values[i] = static_cast<double>(number_at<T, is_swapped>(first + i * stride));
}

template <bool is_swapped>
Decode decoder(NumberType type) {
  constexpr std::array<Decode, 8> all = {decode<std::int8_t, is_swapped>,  decode<std::uint8_t, is_swapped>,
                                         decode<std::int16_t, is_swapped>, decode<std::uint16_t, is_swapped>,
                                         decode<std::int32_t, is_swapped>, decode<std::uint32_t, is_swapped>,
                                         decode<float, is_swapped>,        decode<double, is_swapped>};
  return all[static_cast<std::size_t>(type)];
}

}  // namespace

std::size_t size_in_bytes(NumberType type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::uint8_t as_byte(double value) {
  return value > 0 ? static_cast<std::uint8_t>(std::min(255.0, std::round(value))) : std::uint8_t{0};
}

Decode decoder(NumberType type, bool is_big_endian) {
  const bool is_native = is_big_endian == (std::endian::native == std::endian::big);
  return is_native ? decoder<false>(type) : decoder<true>(type);
}

}  // namespace relievo::io
