// The numbers that a TIFF picture has per pixel. Tested by tests/io/depth_tiff_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace relievo::io {

enum class SampleKind { whole, signed_whole, fraction };

struct SampleFormat {
  SampleKind kind = SampleKind::whole;
  unsigned bits = 1;
};

// Returns the format of the tags SampleFormat and BitsPerSample if it is supported: whole numbers of 1 to 32
// and of 64 bits, signed ones of 8, 16, 32 and 64, and fractions of 16, 32 and 64. Undefined samples are
// taken as whole numbers.
std::optional<SampleFormat> find_sample_format(unsigned sample_format, unsigned bits);

// Returns a description of the samples for messages: "4-bit whole numbers".
std::string describe_samples(unsigned sample_format, unsigned bits);

// A row as libtiff returns it. Every `step`-th sample is read, from the sample `first` on.
struct SampleRow {
  const unsigned char* bytes = nullptr;
  std::size_t first = 0, step = 1;
};

// Decodes n samples of a row: numbers of 8, 16, 24, 32 and 64 bits in the machine's byte order, which is
// little-endian, and all other widths packed, the most significant bit first.
void decode_samples(const SampleFormat& format, const SampleRow& row, std::size_t n, float* to);

}  // namespace relievo::io
