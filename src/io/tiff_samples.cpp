#include "io/tiff_samples.h"

#include <tiff.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace relievo::io {
namespace {

std::uint64_t little_endian(const unsigned char* first, unsigned bits) {
  std::uint64_t value = 0;
  std::memcpy(&value, first, bits / 8);
  return value;
}

std::uint64_t packed(const unsigned char* row, std::size_t first_bit, unsigned bits) {
  std::uint64_t value = 0;
  for (std::size_t bit = first_bit; bit < first_bit + bits; ++bit)
    value = value << 1 | (row[bit / 8] >> (7 - bit % 8) & 1U);
  return value;
}

// Converts a number of 16 bits (IEEE 754 half precision).
float half(std::uint64_t bits) {
  const auto exponent = static_cast<int>(bits >> 10 & 31), fraction = static_cast<int>(bits & 1023);
  const float sign = bits >> 15 & 1 ? -1.F : 1.F;
  if (exponent == 31) return fraction ? std::nanf("") : sign * HUGE_VALF;
  if (exponent == 0) return sign * std::ldexp(static_cast<float>(fraction), -24);
  return sign * std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
}

float as_fraction(std::uint64_t bits, unsigned size) {
  if (size == 16) return half(bits);
  if (size == 32) return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  return static_cast<float>(std::bit_cast<double>(bits));
}

float as_signed(std::uint64_t bits, unsigned size) {
  const unsigned unused = 64 - size;
  return static_cast<float>(static_cast<std::int64_t>(bits << unused) >> unused);
}

}  // namespace

std::optional<SampleFormat> find_sample_format(unsigned sample_format, unsigned bits) {
  const auto is_one_of = [&](auto... sizes) { return ((bits == sizes) || ...); };
  if (sample_format == SAMPLEFORMAT_UINT || sample_format == SAMPLEFORMAT_VOID) {
    if ((bits >= 1 && bits <= 32) || bits == 64) return SampleFormat{SampleKind::whole, bits};
  } else if (sample_format == SAMPLEFORMAT_INT) {
    if (is_one_of(8U, 16U, 32U, 64U)) return SampleFormat{SampleKind::signed_whole, bits};
  } else if (sample_format == SAMPLEFORMAT_IEEEFP) {
    if (is_one_of(16U, 32U, 64U)) return SampleFormat{SampleKind::fraction, bits};
  }
  return std::nullopt;
}

std::string describe_samples(unsigned sample_format, unsigned bits) {
  constexpr std::array names = {"numbers", "whole numbers", "signed numbers", "fractions",
                                "undefined numbers"};
  const std::size_t known = sample_format < names.size() ? sample_format : 0;
  return std::to_string(bits) + "-bit " + (sample_format > 4 ? "complex numbers" : names[known]);
}

void decode_samples(const SampleFormat& format, const SampleRow& row, std::size_t n, float* to) {
  const unsigned bits = format.bits;
  const bool is_packed = bits % 8 != 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t sample = row.first + i * row.step;
    const std::uint64_t value = is_packed ? packed(row.bytes, sample * bits, bits)
                                          : little_endian(row.bytes + sample * (bits / 8), bits);
    if (format.kind == SampleKind::whole) to[i] = static_cast<float>(value);
    if (format.kind == SampleKind::signed_whole) to[i] = as_signed(value, bits);
    if (format.kind == SampleKind::fraction) to[i] = as_fraction(value, bits);
  }
}

}  // namespace relievo::io
