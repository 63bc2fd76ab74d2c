// Reads and writes TIFF files in memory with libtiff.
#pragma once

#include <tiffio.h>
#include <cstddef>
#include <optional>

#include <string>
#include <string_view>
#include <vector>

#include "io/pictures/samples.h"

namespace relievo::io {

// A TIFF in memory. The first error message of libtiff is stored instead of printed.
class TiffBytes {
 public:
  explicit TiffBytes(std::string_view bytes);       // for reading
  explicit TiffBytes(std::vector<std::byte>& out);  // for writing
  TiffBytes(const TiffBytes&) = delete;
  TiffBytes& operator=(const TiffBytes&) = delete;
  ~TiffBytes() { close(); }

  TIFF* handle() const { return tiff_; }  // null if the bytes are not a TIFF
  const std::string& message() const { return message_; }
  void close();
  // Abandons the handle without closing it. libtiff crashes when it closes a file whose tags could not be
  // stored for lack of memory.
  void abandon() { tiff_ = nullptr; }

 private:
  static int keep_message(TIFF*, void* self, const char* module, const char* format, va_list arguments);
  void open(const char* mode);
  static tmsize_t read(thandle_t self, void* to, tmsize_t size);
  static tmsize_t write(thandle_t self, void* from, tmsize_t size);
  static toff_t seek(thandle_t self, toff_t offset, int from);
  static toff_t size(thandle_t self);

  std::string_view bytes_;
  std::vector<std::byte>* out_ = nullptr;
  std::size_t at_ = 0;
  std::string message_;
  TIFF* tiff_ = nullptr;
};

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
