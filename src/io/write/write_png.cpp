// Writes PNG with libspng.
#include <spng.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "relievo/core/image.h"
#include "relievo/io/write.h"

namespace relievo {
namespace {

using Encoder = std::unique_ptr<spng_ctx, decltype([](spng_ctx* spng) { spng_ctx_free(spng); })>;
using Encoded = std::unique_ptr<void, decltype([](void* bytes) { std::free(bytes); })>;

constexpr std::uint32_t longest_side_px = 1'000'000;  // read_depth_image() accepts no longer side

template <typename T>
bool has_pixels(const Image<T>& image) {
  const bool is_known = image.channels == 1 || image.channels == 3 || image.channels == 4;
  return is_known && image.width > 0 && image.height > 0 &&
         image.pixels.size() == image.index(0, image.height);
}

spng_color_type colour_type(int channels) {
  return channels == 1   ? SPNG_COLOR_TYPE_GRAYSCALE
         : channels == 3 ? SPNG_COLOR_TYPE_TRUECOLOR
                         : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
}

// Functions of libspng return 0 if they succeed, else an error code.
template <typename T>
bool set_header(spng_ctx* spng, const Image<T>& image) {
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(image.width);
  header.height = static_cast<std::uint32_t>(image.height);
  header.bit_depth = 8 * sizeof(T);
  header.color_type = static_cast<std::uint8_t>(colour_type(image.channels));
  // Level 3 compresses smooth shading nearly as well as level 9, and is several times faster.
  return spng_set_image_limits(spng, longest_side_px, longest_side_px) == 0 &&
         spng_set_ihdr(spng, &header) == 0 && spng_set_option(spng, SPNG_ENCODE_TO_BUFFER, 1) == 0 &&
         spng_set_option(spng, SPNG_IMG_COMPRESSION_LEVEL, 3) == 0 &&
         spng_set_option(spng, SPNG_FILTER_CHOICE,
                         SPNG_FILTER_CHOICE_SUB | SPNG_FILTER_CHOICE_UP | SPNG_FILTER_CHOICE_PAETH) == 0;
}

bool set_texts(spng_ctx* spng, PngTexts texts) {
  std::vector<spng_text> chunks;
  for (const auto& [key, value] : texts) {
    spng_text& chunk = chunks.emplace_back();
    if (key.size() >= sizeof chunk.keyword) return false;
    std::ranges::copy(key, chunk.keyword);
    chunk.type = SPNG_TEXT;
    chunk.text = const_cast<char*>(value.c_str());  // libspng does not write to it
    chunk.length = value.size();
  }
  return chunks.empty() || spng_set_text(spng, chunks.data(), static_cast<std::uint32_t>(chunks.size())) == 0;
}

bool set_pixel_size(spng_ctx* spng, double mm_per_pixel) {
  const double per_metre = mm_per_pixel > 0 ? std::round(1000 / mm_per_pixel) : 0;
  if (!(per_metre > 0 && per_metre < 1e9)) return true;
  spng_phys size{static_cast<std::uint32_t>(per_metre), static_cast<std::uint32_t>(per_metre), 1};
  return spng_set_phys(spng, &size) == 0;
}

template <typename Grey>
std::vector<std::byte> encode(const Image<Grey>& image, const PngLabel& label) {
  const Encoder spng(has_pixels(image) ? spng_ctx_new(SPNG_CTX_ENCODER) : nullptr);
  if (!spng || !set_header(spng.get(), image) || !set_texts(spng.get(), label.text) ||
      !set_pixel_size(spng.get(), label.mm_per_pixel) ||
      spng_encode_image(spng.get(), image.pixels.data(), image.pixels.size() * sizeof(Grey), SPNG_FMT_PNG,
                        SPNG_ENCODE_FINALIZE) != 0)
    return {};
  std::size_t size = 0;
  int failed = 0;
  const Encoded bytes(spng_get_png_buffer(spng.get(), &size, &failed));
  if (!bytes) return {};
  const auto* first = static_cast<const std::byte*>(bytes.get());
  return {first, first + size};
}

}  // namespace

std::vector<std::byte> write_png(const Image8& image) {
  return encode(image, {});
}

std::vector<std::byte> write_png(const Image16& image, const PngLabel& label) {
  return encode(image, label);
}

std::vector<std::byte> write_labelled_png(const Image8& image, const PngLabel& label) {
  return encode(image, label);
}

}  // namespace relievo
