// Reads PNG files with libspng.
#include <spng.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>

#include "io/pictures.h"
#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr std::uint32_t longest_side_px = 1'000'000;

// Gives libspng the bytes of a file without its ancillary chunks. These chunks may be large or broken, and
// libspng would allocate as much memory as their lengths promise.
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

  // Moves to the next critical chunk: the names of ancillary chunks begin with a small letter.
  void find_needed() {
    constexpr std::size_t head = 8, around_data = 12;
    while (bytes_.size() - at_ >= head) {
      std::uint64_t length = 0;
      for (std::size_t i = 0; i < 4; ++i) length = 256 * length + static_cast<unsigned char>(bytes_[at_ + i]);
      end_ = at_ + around_data + length;
      if ((bytes_[at_ + 4] & 0x20) == 0) return;
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
    if (pixels * colours_ * value_size_ / best_packing > source_.bytes.size())
      return source_.error({}, cat("expected more data for ", pixels, " pixels, found ", source_.bytes.size(),
                                   " bytes; the file is cut, get it anew"));
    std::vector<std::uint8_t> values(pixels * channels_ * value_size_);
    int failure = spng_decode_image(spng_.get(), values.data(), values.size(), format_, 0);
    if (failure == 0) failure = spng_decode_chunks(spng_.get());
    if (failure != 0) return broken(failure);
    return as_depths(values);
  }

 private:
  // Palettes are converted to colours, and grey of fewer than 8 bits to 8 bits. Alpha is read, but not used.
  void choose_format() {
    const int type = header_.color_type;
    const bool has_palette = type == SPNG_COLOR_TYPE_INDEXED, is_narrow = header_.bit_depth < 8;
    const bool has_alpha = type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA || type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    const bool is_grey = type == SPNG_COLOR_TYPE_GRAYSCALE || type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
    format_ = has_palette ? SPNG_FMT_RGB8 : is_narrow ? SPNG_FMT_G8 : SPNG_FMT_PNG;
    colours_ = is_grey ? 1 : 3;
    channels_ = colours_ + (has_alpha ? 1 : 0);
    value_size_ = header_.bit_depth == 16 ? 2 : 1;
  }

  std::unexpected<Error> broken(int failure) const {
    const std::string_view what = failure == SPNG_IO_EOF ? "the end of the file" : spng_strerror(failure);
    return source_.error_at_byte(chunks_.at(), cat("expected the data of a PNG picture, found ", what));
  }

  Result<DepthImage> as_depths(const std::vector<std::uint8_t>& values) const {
    DepthImage image{{}, 1, cat("PNG, ", 8 * value_size_, " bits")};
    image.values.resize(static_cast<int>(header_.width), static_cast<int>(header_.height));
    if (wanted_.channel > static_cast<int>(colours_))
      return source_.error({}, cat("expected a channel from 1 to ", colours_, ", found ", wanted_.channel));
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      const auto value = value_of(values.data() + i * channels_ * value_size_);
      if (!value)
        return source_.error(cat("column ", i % header_.width + 1, ", row ", i / header_.width + 1),
                             cat("expected a grey picture of depths, found colours", way_out_of_colours));
      image.values[i] = *value;
    }
    return image;
  }

  // Returns the value of a pixel; nothing if its channels differ, as in a photograph or in depths that are
  // shown in colours.
  std::optional<float> value_of(const std::uint8_t* pixel) const {
    std::array<float, 3> all{};
    for (std::size_t c = 0; c < colours_; ++c) {
      std::uint16_t value = pixel[c];
      if (value_size_ == 2) std::memcpy(&value, pixel + 2 * c, 2);
      all[c] = value;
    }
    if (wanted_.channel > 0) return all[static_cast<std::size_t>(wanted_.channel) - 1];
    const bool is_grey = colours_ == 1 || (all[0] == all[1] && all[1] == all[2]);
    if (is_grey) return all[0];
    if (!wanted_.is_luminance_wanted) return std::nullopt;
    return luminance_shares[0] * all[0] + luminance_shares[1] * all[1] + luminance_shares[2] * all[2];
  }

  const Source& source_;
  const PictureChannels& wanted_;
  NeededChunks chunks_;
  std::unique_ptr<spng_ctx, decltype([](spng_ctx* spng) { spng_ctx_free(spng); })> spng_{spng_ctx_new(0)};
  spng_ihdr header_{};
  int format_ = SPNG_FMT_PNG;
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
