// PNG through libpng, which reports errors by longjmp: the functions that call setjmp have no local object
// with a destructor.
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <optional>

#include "io/pictures.h"
#include "io/text.h"
#include "relievo/core/text.h"

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
  // libpng allocates what a chunk's length promises before it reads the chunk: all are skipped that are not needed. A
  // palette and its transparency have places of fixed size.
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
  Reader(const Source& source, const PictureChannels& wanted) : source_(source), wanted_(wanted) {
    job_.bytes = source.bytes;
  }
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
      return source_.error({}, cat("expected more data for ", pixels, " pixels, found ", source_.bytes.size(),
                                   " bytes; the file is cut, get it anew"));
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

  Result<DepthImage> as_depths(const std::vector<png_byte>& bytes) const {
    DepthImage image{{}, 1, "PNG, " + std::to_string(job_.bits) + " bits"};
    image.values.resize(static_cast<int>(job_.width), static_cast<int>(job_.height));
    if (wanted_.channel > job_.channels)
      return source_.error({}, "expected a channel from 1 to " + std::to_string(job_.channels) + ", found " +
                                   std::to_string(wanted_.channel));
    const std::size_t value_size = static_cast<std::size_t>(job_.bits / 8);
    const auto channels = static_cast<std::size_t>(job_.channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      const auto value = value_of(bytes.data() + i * channels * value_size);
      if (!value)
        return source_.error(
            "column " + std::to_string(i % job_.width + 1) + ", row " + std::to_string(i / job_.width + 1),
            cat("expected a grey picture of depths, found colours", way_out_of_colours));
      image.values[i] = *value;
    }
    return image;
  }

  // Returns the value of a pixel; nothing if its channels differ: then the picture is a photograph, or depths were
  // painted in colours.
  std::optional<float> value_of(const png_byte* pixel) const {
    std::array<float, 4> all{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(job_.channels); ++c) {
      std::uint16_t value = pixel[c];
      if (job_.bits == 16) std::memcpy(&value, pixel + 2 * c, 2);
      all[c] = value;
    }
    if (wanted_.channel > 0) return all[static_cast<std::size_t>(wanted_.channel) - 1];
    const bool is_grey = job_.channels < 3 || (all[0] == all[1] && all[1] == all[2]);
    if (is_grey) return all[0];
    if (!wanted_.is_luminance_wanted) return std::nullopt;
    return luminance_shares[0] * all[0] + luminance_shares[1] * all[1] + luminance_shares[2] * all[2];
  }

  const Source& source_;
  const PictureChannels& wanted_;
  Job job_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

bool is_png(const Source& source) {
  return source.bytes.starts_with("\x89PNG");
}

Result<DepthImage> read_depth_png(const Source& source, const PictureChannels& channels) {
  return Reader(source, channels).read();
}

}  // namespace relievo::io
