// Reads and writes TIFF files in memory with libtiff.
#pragma once

#include <tiffio.h>

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace relievo::io
