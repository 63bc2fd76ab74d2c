// PNG through libpng. It reports errors by longjmp, so encode() holds nothing that needs a destructor.
#include <png.h>

#include <bit>
#include <cmath>
#include <csetjmp>
#include <new>

#include "relievo/core/image.h"
#include "relievo/io/write.h"
#include "relievo/picture/preview.h"

namespace relievo {
namespace {

// Everything encode() reads, owned by the caller.
struct Job {
  const png_byte* pixels = nullptr;
  png_uint_32 width = 0, height = 0, pixels_per_metre = 0;
  int bit_depth = 8, channels = 1;
  png_text* texts = nullptr;
  int text_count = 0;
  std::vector<std::byte>* out = nullptr;
};

void fail(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, png_size_t size) {
  auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  bool is_full = false;
  try {
    out.insert(out.end(), bytes, bytes + size);
  } catch (const std::bad_alloc&) {
    is_full = true;  // libpng is C: no exception may pass through it
  }
  if (is_full) png_error(png, "out of memory");
}

int colour_type(int channels) {
  return channels == 1 ? PNG_COLOR_TYPE_GRAY : channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA;
}

void write_header(png_structp png, png_infop info, const Job& job) {
  png_set_IHDR(png, info, job.width, job.height, job.bit_depth, colour_type(job.channels), PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (job.pixels_per_metre > 0)
    png_set_pHYs(png, info, job.pixels_per_metre, job.pixels_per_metre, PNG_RESOLUTION_METER);
  if (job.text_count > 0) png_set_text(png, info, job.texts, job.text_count);
  png_write_info(png, info);
}

bool encode(png_structp png, png_infop info, const Job& job) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, job.out, append, nullptr);
  // Smooth shading packs nearly as well at level 3 as at 9, several times faster.
  png_set_compression_level(png, 3);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP | PNG_FILTER_PAETH);
  write_header(png, info, job);
  if (job.bit_depth == 16 && std::endian::native == std::endian::little) png_set_swap(png);
  const std::size_t row_size =
      std::size_t{job.width} * static_cast<std::size_t>(job.channels * job.bit_depth / 8);
  for (std::size_t row = 0; row < job.height; ++row) png_write_row(png, job.pixels + row * row_size);
  png_write_end(png, info);
  return true;
}

std::vector<std::byte> encode(Job job) {
  std::vector<std::byte> bytes;
  job.out = &bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool is_done = info && encode(png, info, job);
  png_destroy_write_struct(&png, &info);
  if (!is_done) bytes.clear();
  return bytes;
}

template <typename T>
bool has_pixels(const Image<T>& image) {
  const bool is_known = image.channels == 1 || image.channels == 3 || image.channels == 4;
  return is_known && image.width > 0 && image.height > 0 &&
         image.pixels.size() == image.index(0, image.height);
}

template <typename T>
Job job_for(const Image<T>& image) {
  Job job;
  job.pixels = reinterpret_cast<const png_byte*>(image.pixels.data());
  job.width = static_cast<png_uint_32>(image.width);
  job.height = static_cast<png_uint_32>(image.height);
  job.channels = image.channels;
  job.bit_depth = 8 * sizeof(T);
  return job;
}

png_text text_chunk(const std::pair<std::string, std::string>& text) {
  png_text chunk{};
  chunk.compression = PNG_TEXT_COMPRESSION_NONE;
  // libpng takes pointers to non-const but does not write through them.
  chunk.key = const_cast<char*>(text.first.c_str());
  chunk.text = const_cast<char*>(text.second.c_str());
  chunk.text_length = text.second.size();
  return chunk;
}

}  // namespace

std::vector<std::byte> write_png(const Image8& image) {
  return has_pixels(image) ? encode(job_for(image)) : std::vector<std::byte>{};
}

std::vector<std::byte> write_png(const Image16& image,
                                 std::span<const std::pair<std::string, std::string>> text,
                                 double mm_per_pixel) {
  if (!has_pixels(image)) return {};
  std::vector<png_text> chunks;
  for (const auto& pair : text) chunks.push_back(text_chunk(pair));
  Job job = job_for(image);
  job.texts = chunks.data();
  job.text_count = static_cast<int>(chunks.size());
  const double pixels_per_metre = mm_per_pixel > 0 ? std::round(1000 / mm_per_pixel) : 0;
  if (pixels_per_metre < 1e9) job.pixels_per_metre = static_cast<png_uint_32>(pixels_per_metre);
  return encode(job);
}

}  // namespace relievo
