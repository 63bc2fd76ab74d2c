// Decodes the numbers that encode a picture's values in TIFF, NPY and PFM.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace relievo::io {

enum class SampleKind { whole, signed_whole, fraction };

struct SampleFormat {
  SampleKind kind = SampleKind::whole;
  unsigned bits = 1;
};

// Returns the number that 16 bits represent (IEEE 754 half precision).
inline float half_precision(std::uint64_t bits) {
  const auto exponent = static_cast<int>(bits >> 10 & 31), fraction = static_cast<int>(bits & 1023);
  const float sign = bits >> 15 & 1 ? -1.F : 1.F;
  if (exponent == 31) return fraction ? std::nanf("") : sign * HUGE_VALF;
  if (exponent == 0) return sign * std::ldexp(static_cast<float>(fraction), -24);
  return sign * std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
}

// Returns the number that the lowest bits represent: integers of 1 to 64 bits, in two's complement if signed,
// or floating-point numbers of 16, 32 and 64 bits (IEEE 754).
template <typename Number = float>
Number decode_sample(const SampleFormat& format, std::uint64_t bits) {
  const unsigned unused = 64 - format.bits;
  if (format.kind == SampleKind::whole) return static_cast<Number>(bits);
  if (format.kind == SampleKind::signed_whole)
    return static_cast<Number>(static_cast<std::int64_t>(bits << unused) >> unused);
  if (format.bits == 16) return Number{half_precision(bits)};
  if (format.bits == 32) return Number{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
  return static_cast<Number>(std::bit_cast<double>(bits));
}

// Returns the integer in `bytes` bytes, at most 8, with that byte order.
inline std::uint64_t whole_number(const char* first, unsigned bytes, bool is_big_endian) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) {
    const unsigned place = is_big_endian ? bytes - 1 - i : i;
    value |= std::uint64_t{static_cast<unsigned char>(first[i])} << 8 * place;
  }
  return value;
}

}  // namespace relievo::io
