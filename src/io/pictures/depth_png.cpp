// Reads PNG files with libspng.
#include <spng.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>

#include "io/pictures/pictures.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::uint32_t longest_side_px = 1'000'000;

// Passes the bytes of a file to libspng, but leaves out all ancillary chunks except that of transparent
// colours. Ancillary chunks may be large or broken, and libspng would allocate the memory that they claim to
// need.
class NeededChunks {
 public:
  explicit NeededChunks(std::string_view bytes) : bytes_(bytes) {}

  std::size_t at() const { return at_; }

  static int read(spng_ctx*, void* chunks, void* to, std::size_t size) {
    return static_cast<NeededChunks*>(chunks)->take(static_cast<char*>(to), size);
  }

 private:
  int take(char* to, std::size_t size) {
    while (size > 0) {
      if (at_ == end_) find_needed();
      const std::size_t part =
          std::min<std::size_t>(size, std::min<std::uint64_t>(end_, bytes_.size()) - at_);
      if (part == 0) return SPNG_IO_EOF;
      std::memcpy(to, bytes_.data() + at_, part);
      at_ += part, to += part, size -= part;
    }
    return 0;
  }

  // Moves to the next critical chunk, or to the chunk of transparent colours, which has at most a byte per
  // palette entry. Names of ancillary chunks begin with a lower-case letter.
  void find_needed() {
    constexpr std::size_t head = 8, around_data = 12;
    while (bytes_.size() - at_ >= head) {
      std::uint64_t length = 0;
      for (std::size_t i = 0; i < 4; ++i) length = 256 * length + static_cast<unsigned char>(bytes_[at_ + i]);
      end_ = at_ + around_data + length;
      const bool are_colours = bytes_.substr(at_ + 4, 4) == "tRNS" && length <= 256;
      if ((bytes_[at_ + 4] & 0x20) == 0 || are_colours) return;
      at_ = static_cast<std::size_t>(std::min<std::uint64_t>(end_, bytes_.size()));
    }
    end_ = bytes_.size();
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t end_ = 8;  // end of the signature or of the current chunk
};

class Reader {
 public:
  Reader(const Source& source, const PictureChannels& wanted)
      : source_(source), wanted_(wanted), chunks_(source.bytes) {}

  Result<DepthImage> read() {
    if (!spng_) return source_.error({}, "expected memory for the picture, found none");
    spng_set_image_limits(spng_.get(), longest_side_px, longest_side_px);
    spng_set_png_stream(spng_.get(), NeededChunks::read, &chunks_);
    if (const int failure = spng_get_ihdr(spng_.get(), &header_)) return broken(failure);
    choose_format();
    const std::size_t pixels = std::size_t{header_.width} * header_.height;
    if (pixels > most_pixels)
      return source_.error({}, "expected at most 134217728 pixels, found " + std::to_string(pixels));
    RELIEVO_CHECK(check_packing(source_, pixels, pixels * colours_ * value_size_));
    std::vector<std::uint8_t> values(pixels * channels_ * value_size_);
    int failure = spng_decode_image(spng_.get(), values.data(), values.size(), format_,
                                    has_transparent_colour_ ? SPNG_DECODE_TRNS : 0);
    if (failure == 0) failure = spng_decode_chunks(spng_.get());
    if (failure != 0) return broken(failure);
    return as_depths(values);
  }

 private:
  // Palettes are converted to colours, and grey of less than 8 bits to 8 bits. A transparent colour in the
  // file becomes alpha.
  void choose_format() {
    const int type = header_.color_type;
    const bool has_palette = type == SPNG_COLOR_TYPE_INDEXED, is_narrow = header_.bit_depth < 8;
    const bool has_alpha = type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA || type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    const bool is_grey = type == SPNG_COLOR_TYPE_GRAYSCALE || type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
    const bool is_wide = header_.bit_depth == 16;
    spng_trns trns{};
    has_transparent_colour_ = spng_get_trns(spng_.get(), &trns) == 0;
    format_ = has_palette ? SPNG_FMT_RGB8 : is_narrow ? SPNG_FMT_G8 : SPNG_FMT_PNG;
    if (has_transparent_colour_)
      format_ = is_grey   ? (is_wide ? SPNG_FMT_GA16 : SPNG_FMT_GA8)
                : is_wide ? SPNG_FMT_RGBA16
                          : SPNG_FMT_RGBA8;
    colours_ = is_grey ? 1 : 3;
    channels_ = colours_ + (has_alpha || has_transparent_colour_ ? 1 : 0);
    value_size_ = is_wide ? 2 : 1;
  }

  std::unexpected<Error> broken(int failure) const {
    const std::string_view what = failure == SPNG_IO_EOF ? "the end of the file" : spng_strerror(failure);
    return source_.error_at_byte(chunks_.at(), cat("expected the data of a PNG picture, found ", what));
  }

  Result<DepthImage> as_depths(const std::vector<std::uint8_t>& values) const {
    DepthImage image{{}, 1, cat("PNG, ", 8 * value_size_, " bits")};
    image.values.resize(static_cast<int>(header_.width), static_cast<int>(header_.height));
    const auto at = [&](std::size_t pixel, std::size_t channel) {
      return sample(values.data() + (pixel * channels_ + channel) * value_size_);
    };
    RELIEVO_CHECK(fill_values(source_, wanted_, colours_, image.values, [&](std::size_t i) {
      return colours_ == 1 ? PixelColour{at(i, 0)} : PixelColour{at(i, 0), at(i, 1), at(i, 2)};
    }));
    const float opaque = value_size_ == 2 ? 65535 : 255;
    for (std::size_t i = 0; channels_ > colours_ && i < image.values.size(); ++i)
      if (at(i, colours_) < opaque / 2) image.values[i] = std::numeric_limits<float>::quiet_NaN();
    return image;
  }

  float sample(const std::uint8_t* from) const {
    std::uint16_t value = *from;
    if (value_size_ == 2) std::memcpy(&value, from, 2);
    return value;
  }

  const Source& source_;
  const PictureChannels& wanted_;
  NeededChunks chunks_;
  std::unique_ptr<spng_ctx, decltype([](spng_ctx* spng) { spng_ctx_free(spng); })> spng_{spng_ctx_new(0)};
  spng_ihdr header_{};
  int format_ = SPNG_FMT_PNG;
  bool has_transparent_colour_ = false;
  std::size_t colours_ = 0, channels_ = 0, value_size_ = 0;  // channels are colours and alpha
};

}  // namespace

bool is_png(const Source& source) {
  return source.bytes.starts_with("\x89PNG");
}

Result<DepthImage> read_depth_png(const Source& source, const PictureChannels& channels) {
  return Reader(source, channels).read();
}

}  // namespace relievo::io
