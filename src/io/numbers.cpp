#include "io/numbers.h"

#include <array>
#include <bit>

namespace relievo::io {
namespace {

template <std::size_t bytes>
struct BitsOf;
template <>
struct BitsOf<1> {
  using type = std::uint8_t;
};
template <>
struct BitsOf<2> {
  using type = std::uint16_t;
};
template <>
struct BitsOf<4> {
  using type = std::uint32_t;
};
template <>
struct BitsOf<8> {
  using type = std::uint64_t;
};

template <typename T, bool is_swapped>
void decode(const char* first, std::size_t stride, std::size_t rows, double* values) {
  for (std::size_t i = 0; i < rows; ++i) {
    typename BitsOf<sizeof(T)>::type bits;
    std::memcpy(&bits, first + i * stride, sizeof(T));
    if constexpr (is_swapped) bits = std::byteswap(bits);
    values[i] = static_cast<double>(std::bit_cast<T>(bits));
  }
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

Decode decoder(NumberType type, bool is_big_endian) {
  const bool is_native = is_big_endian == (std::endian::native == std::endian::big);
  return is_native ? decoder<false>(type) : decoder<true>(type);
}

}  // namespace relievo::io
