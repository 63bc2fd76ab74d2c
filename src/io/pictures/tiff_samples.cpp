#include "io/pictures/tiff_samples.h"

#include <tiff.h>

#include <array>
#include <cstdint>
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
    to[i] = decode_sample(format, value);
  }
}

}  // namespace relievo::io
