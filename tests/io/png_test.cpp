#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <map>

#include "relievo/core/image.h"
#include "relievo/io/write.h"
#include "relievo/picture/preview.h"

namespace relievo {
namespace {

// A picture as libpng decodes it. An error of libpng ends the test program.
struct Decoded {
  int width = 0, height = 0, bits = 0, colour_type = 0;
  std::vector<std::byte> samples;  // as stored: 16-bit samples big-endian
  std::map<std::string, std::string> text;
  unsigned pixels_per_metre = 0;
};

void take(png_structp png, png_bytep to, png_size_t size) {
  auto& rest = *static_cast<std::span<const std::byte>*>(png_get_io_ptr(png));
  if (size > rest.size()) png_error(png, "the file ends too early");
  std::memcpy(to, rest.data(), size);
  rest = rest.subspan(size);
}

Decoded decode(std::span<const std::byte> bytes) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &bytes, take);
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  Decoded image;
  image.width = static_cast<int>(png_get_image_width(png, info));
  image.height = static_cast<int>(png_get_image_height(png, info));
  image.bits = png_get_bit_depth(png, info);
  image.colour_type = png_get_color_type(png, info);
  image.pixels_per_metre = png_get_pixels_per_meter(png, info);
  const png_bytepp rows = png_get_rows(png, info);
  for (int row = 0; row < image.height; ++row) {
    const auto* first = reinterpret_cast<const std::byte*>(rows[row]);
    image.samples.insert(image.samples.end(), first, first + png_get_rowbytes(png, info));
  }
  png_textp text = nullptr;
  const int texts = png_get_text(png, info, &text, nullptr);
  for (int i = 0; i < texts; ++i) image.text[text[i].key] = text[i].text;
  png_destroy_read_struct(&png, &info, nullptr);
  EXPECT_TRUE(bytes.empty()) << "bytes after the end";
  return image;
}

// Returns an image of ramps, jumps and slight noise, for which each filter of PNG is useful somewhere. Its
// values range from the smallest to the largest number of the type.
template <typename T>
Image<T> pattern(int width, int height, int channels) {
  Image<T> image{width, height, channels, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < width * height * channels; ++i) {
    state = state * 1664525 + 1013904223;
    const bool is_noise = i % 7 == 0;
    image.pixels.push_back(static_cast<T>(is_noise ? state >> 16 : static_cast<std::uint32_t>(i) * 37));
  }
  image.pixels.front() = 0;
  image.pixels.back() = std::numeric_limits<T>::max();
  return image;
}

TEST(WritePng, KeepsEveryPixelOfColourAndGrey) {
  for (const auto& [channels, type] :
       {std::pair{1, PNG_COLOR_TYPE_GRAY}, {3, PNG_COLOR_TYPE_RGB}, {4, PNG_COLOR_TYPE_RGBA}}) {
    for (const int width : {1, 2, 17, 300}) {
      const Image8 image = pattern<std::uint8_t>(width, 23, channels);
      const Decoded decoded = decode(write_png(image));
      EXPECT_EQ(decoded.width, width);
      EXPECT_EQ(decoded.height, 23);
      EXPECT_EQ(decoded.bits, 8);
      EXPECT_EQ(decoded.colour_type, type);
      ASSERT_EQ(decoded.samples.size(), image.pixels.size());
      EXPECT_EQ(std::memcmp(decoded.samples.data(), image.pixels.data(), image.pixels.size()), 0);
    }
  }
}

TEST(WritePng, KeepsAllSixteenBits) {
  const Image16 image = pattern<std::uint16_t>(61, 47, 1);
  const Decoded decoded = decode(write_png(image));
  EXPECT_EQ(decoded.bits, 16);
  ASSERT_EQ(decoded.samples.size(), 2 * image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const int value =
        std::to_integer<int>(decoded.samples[2 * i]) * 256 + std::to_integer<int>(decoded.samples[2 * i + 1]);
    ASSERT_EQ(value, image.pixels[i]) << "pixel " << i;
  }
}

TEST(WritePng, StoresTextAndThePixelsSizeIfAsked) {
  const std::vector<std::pair<std::string, std::string>> text{{"Software", "relievo"},
                                                              {"mm per grey", "0.000123"}};
  const Image16 image = pattern<std::uint16_t>(5, 4, 1);
  const Decoded asked = decode(write_png(image, {text, 0.25})), unasked = decode(write_png(image));
  EXPECT_EQ(asked.text, (std::map<std::string, std::string>(text.begin(), text.end())));
  EXPECT_EQ(asked.pixels_per_metre, 4000U);
  EXPECT_TRUE(unasked.text.empty());
  EXPECT_EQ(unasked.pixels_per_metre, 0U);
}

TEST(WritePng, GivesNoBytesForWhatIsNoPicture) {
  EXPECT_TRUE(write_png(Image8{}).empty());
  EXPECT_TRUE(write_png(Image16{}).empty());
  EXPECT_TRUE(write_png(Image8{-2, -2, 1, {1, 2, 3, 4}}).empty());
  EXPECT_TRUE(write_png(Image8{2, 2, 1, {1, 2, 3}}).empty());
  EXPECT_TRUE(write_png(Image8{2, 1, 2, {1, 2, 3, 4}}).empty());
}

TEST(WritePng, GivesNoBytesWhenLibspngRefuses) {
  const Image16 image = pattern<std::uint16_t>(5, 4, 1);
  const std::vector<std::pair<std::string, std::string>> no_key{{"", "value"}};
  EXPECT_TRUE(write_png(image, {no_key}).empty());
  const std::vector<std::pair<std::string, std::string>> no_value{{"empty", ""}};
  EXPECT_TRUE(write_png(image, {no_value}).empty());
  const Image8 too_wide{2000000, 1, 1, std::vector<std::uint8_t>(2000000)};
  EXPECT_TRUE(write_png(too_wide).empty());
}

}  // namespace
}  // namespace relievo
