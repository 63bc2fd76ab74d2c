// PNG through libpng, which reports errors by longjmp: the functions that call setjmp have no local object
// with a destructor.
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>

#include "io/pictures.h"
#include "io/text.h"

namespace relievo::io {
namespace {

// The state that libpng's callbacks share; owned by Reader.
struct Job {
  std::string_view bytes;
  std::size_t at = 0;
  png_uint_32 width = 0, height = 0;
  int channels = 0, bits = 0;
  char message[96] = {};
};

void fail(png_structp png, png_const_charp message) {
  auto& job = *static_cast<Job*>(png_get_error_ptr(png));
  std::strncpy(job.message, message, sizeof job.message - 1);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void take(png_structp png, png_bytep to, png_size_t size) {
  auto& job = *static_cast<Job*>(png_get_io_ptr(png));
  if (size > job.bytes.size() - job.at) png_error(png, "the end of the file");
  std::memcpy(to, job.bytes.data() + job.at, size);
  job.at += size;
}

// Sets up the conversion: grey to 8 or 16 bits, palettes to colours, no transparency.
bool read_header(png_structp png, png_infop info, Job& job) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, &job, take);
  // libpng allocates what a chunk's length promises before it reads the chunk: texts and profiles are
  // skipped, and the limit is for the others. A palette needs less than 1 kB.
  png_set_chunk_malloc_max(png, 8 << 20);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_strip_alpha(png);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  job.width = png_get_image_width(png, info);
  job.height = png_get_image_height(png, info);
  job.channels = png_get_channels(png, info);
  job.bits = png_get_bit_depth(png, info);
  return true;
}

bool read_rows(png_structp png, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

class Reader {
 public:
  explicit Reader(const Source& source) : source_(source) { job_.bytes = source.bytes; }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  Result<DepthImage> read() {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job_, fail, ignore);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) return source_.error({}, "expected memory for the picture, found none");
    if (!read_header(png_, info_, job_)) return broken();
    const std::size_t pixels = std::size_t{job_.width} * job_.height;
    if (pixels > most_pixels)
      return source_.error({}, "expected at most 134217728 pixels, found " + std::to_string(pixels));
    const std::size_t row = png_get_rowbytes(png_, info_);
    if (row * job_.height / best_packing > source_.bytes.size())
      return source_.error({}, "expected more data for " + std::to_string(pixels) + " pixels");
    std::vector<png_byte> bytes(row * job_.height);
    std::vector<png_bytep> rows(job_.height);
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r] = bytes.data() + r * row;
    if (!read_rows(png_, rows.data())) return broken();
    return as_depths(bytes);
  }

 private:
  std::unexpected<Error> broken() const {
    return source_.error_at_byte(job_.at,
                                 "expected the data of a PNG picture, found " + printable(job_.message));
  }

  // Fails if the channels differ: then the picture is a photograph, or depths were painted in colours.
  Result<DepthImage> as_depths(const std::vector<png_byte>& bytes) const {
    DepthImage image{{}, 1, "PNG, " + std::to_string(job_.bits) + " bits"};
    image.values.resize(static_cast<int>(job_.width), static_cast<int>(job_.height));
    const std::size_t value_size = static_cast<std::size_t>(job_.bits / 8);
    const auto channels = static_cast<std::size_t>(job_.channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      const png_byte* pixel = bytes.data() + i * channels * value_size;
      for (std::size_t c = 1; c < channels; ++c)
        if (std::memcmp(pixel, pixel + c * value_size, value_size) != 0)
          return source_.error(
              "column " + std::to_string(i % job_.width + 1) + ", row " + std::to_string(i / job_.width + 1),
              "expected a grey picture of depths, found colours");
      std::uint16_t value = *pixel;
      if (value_size == 2) std::memcpy(&value, pixel, 2);
      image.values[i] = value;
    }
    return image;
  }

  const Source& source_;
  Job job_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

bool is_png(const Source& source) {
  return source.bytes.starts_with("\x89PNG");
}

Result<DepthImage> read_depth_png(const Source& source) {
  return Reader(source).read();
}

}  // namespace relievo::io
