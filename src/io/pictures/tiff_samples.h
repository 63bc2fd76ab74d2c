// Decodes the numbers in the rows of a TIFF picture.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "io/pictures/samples.h"

namespace relievo::io {

// A row from libtiff. Every `step`-th sample is used, starting with sample `first`.
struct SampleRow {
  const unsigned char* bytes = nullptr;
  std::size_t first = 0, step = 1;
};

// Returns the format for the tags SampleFormat and BitsPerSample; nothing if it is not supported. Supported
// are unsigned integers of 1 to 32 and of 64 bits, signed integers of 8, 16, 32 and 64 bits, and
// floating-point numbers of 16, 32 and 64 bits. Messages call floating-point numbers fractions. Undefined
// samples count as unsigned integers.
std::optional<SampleFormat> find_sample_format(unsigned sample_format, unsigned bits);

// Returns a description of the samples for messages: "4-bit whole numbers".
std::string describe_samples(unsigned sample_format, unsigned bits);

// Decodes n samples of a row. Numbers of 8, 16, 24, 32 and 64 bits are in the machine's byte order, which is
// little-endian. Other widths are packed, most significant bit first.
void decode_samples(const SampleFormat& format, const SampleRow& row, std::size_t n, float* to);

}  // namespace relievo::io
