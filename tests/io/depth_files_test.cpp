// Tests reading depth images from PNG and TIFF files, whole and broken.
#include <atomic>
#include <cstdlib>

#include "relievo/core/image.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"
#include "support/format_samples.h"
#include "support/read_text.h"

// The size in bytes of the largest allocation. The malloc() below measures it: it replaces the system's malloc() in the
// test program and its libraries. Sanitizers have their own malloc(), so nothing is measured in their builds.
static std::atomic<std::size_t> largest_allocation = 0;

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RELIEVO_WATCHES_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t bytes);  // NOLINT: the library has this name
extern "C" void* malloc(std::size_t bytes) {
  if (bytes > largest_allocation) largest_allocation = bytes;
  return __libc_malloc(bytes);
}
#endif

namespace relievo {
namespace {

Image16 grey16() {
  Image16 image{5, 4, 1, {}};
  for (int i = 0; i < 20; ++i) image.pixels.push_back(static_cast<std::uint16_t>(3001 * i));
  return image;
}

TEST(ReadDepthImage, ReadsPngOfAnyDepth) {
  const auto sixteen = value_of(read_depth_image(write_png(grey16()), "d"));
  EXPECT_EQ(sixteen.format, "PNG, 16 bits");
  EXPECT_EQ(sixteen.step, 1);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(sixteen.values[i], 3001.F * static_cast<float>(i));
  const Image8 grey{4, 4, 1, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 255}};
  const auto eight = value_of(read_depth_image(write_png(grey), "d"));
  EXPECT_EQ(eight.values[15], 255);
  Image8 colour{4, 4, 3, {}};
  for (const auto v : grey.pixels) colour.pixels.insert(colour.pixels.end(), 3, v);
  EXPECT_EQ(read_depth_image(write_png(colour), "d")->values.pixels, eight.values.pixels);
  colour.pixels[4] = 200;
  expect_image_messages(
      {{as_string(write_png(colour)),
        ", column 2, row 1: expected a grey picture of depths, found colours; the option channel takes one "
        "of them, and depth-values luminance their brightness"}});
}

TEST(ReadDepthImage, TakesOneChannelOfAPngOrItsLuminance) {
  Image8 colour{4, 4, 3, {}};
  for (int i = 0; i < 48; ++i) colour.pixels.push_back(static_cast<std::uint8_t>(5 * i));
  const auto bytes = write_png(colour);
  for (int c = 1; c <= 3; ++c)
    EXPECT_EQ(read_depth_image(bytes, "d", {false, c})->values[7], 5 * (3 * 7 + c - 1)) << c;
  const auto bright = value_of(read_depth_image(bytes, "d", {true}));
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_NEAR(bright.values[i], 15. * static_cast<double>(i) + 5 * (.7152 + 2 * .0722), 1e-4);
  const auto missing = read_depth_image(bytes, "d", {false, 4});
  EXPECT_EQ(missing.error().message(), "d: expected a channel from 1 to 3, found 4");
}

TEST(ReadDepthImage, TransparentPixelsOfAPngAreMissing) {
  Image8 colour{4, 4, 4, {}};
  for (int i = 0; i < 16; ++i) {
    colour.pixels.insert(colour.pixels.end(), 3, static_cast<std::uint8_t>(10 * i));
    colour.pixels.push_back(i < 8 ? 127 : 128);
  }
  const auto image = value_of(read_depth_image(write_png(colour), "d"));
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_TRUE(i < 8 ? std::isnan(image.values[i]) : image.values[i] == 10 * static_cast<float>(i)) << i;
}

// The chunk consists of its length (2), its name, the grey value that is transparent (3001), and its
// checksum.
TEST(ReadDepthImage, TheTransparentGreyOfAPngIsMissing) {
  std::string file = as_string(write_png(grey16()));
  const std::string chunk("\0\0\0\2tRNS\x0B\xB9\x27\xDA\x1F\xDB", 14);
  const auto image = image_in(file.insert(file.find("IDAT") - 4, chunk));
  EXPECT_TRUE(std::isnan(image.values[1]));
  for (std::size_t i = 2; i < 20; ++i) EXPECT_EQ(image.values[i], 3001.F * static_cast<float>(i));
  EXPECT_EQ(image.format, "PNG, 16 bits");
}

TEST(ReadDepthImage, ReadsTheTiffThatWeWrite) {
  HeightsMm heights{{5, 4, 1, {}}, .1};
  for (int i = 0; i < 20; ++i) heights.image.pixels.push_back(.25F * static_cast<float>(i));
  EXPECT_EQ(read_depth_image(write_tiff(heights), "d")->values.pixels, heights.image.pixels);
}

TEST(ReadDepthImage, BrokenPngFieldsAreNamed) {
  const std::string good = as_string(write_png(grey16()));
  const auto with = [&](std::size_t at, std::uint8_t byte) { return patched(good, at, byte); };
  for (const std::string& text :
       {good.substr(0, 20), with(5, 0), with(12, 'J'), with(16, 0x80), with(19, 0), with(23, 0), with(24, 5),
        with(25, 9), with(26, 1), with(28, 7), with(29, 0), good.substr(0, good.size() - 20),
        good.substr(0, good.size() - 12)}) {
    const std::string message = image_message(text);
    EXPECT_TRUE(message.starts_with("d, byte ")) << message;
    EXPECT_TRUE(message.contains("expected the data of a PNG picture, found ")) << message;
  }
  expect_image_messages(
      {{"GIF89a",
        ": expected a picture of depths (PNG, TIFF, JPEG, NPY, PFM, PGM, PPM, BMP, Esri grid, table of "
        "heights), found a GIF picture; save it as PNG"},
       {as_string(write_png(Image8{3, 4, 1, std::vector<std::uint8_t>(12)})),
        ": expected at least 4 x 4 pixels, found 3 x 4"}});
}

// Returns a PNG chunk that states the given length, which may be wrong. Its checksum is wrong, too. That
// does not matter if the reader skips the chunk, because it then does not read the checksum.
std::string png_chunk(const std::string& type, std::uint32_t length, const std::string& data) {
  std::string chunk;
  for (int shift = 24; shift >= 0; shift -= 8) chunk += static_cast<char>(length >> shift);
  return chunk + type + data + std::string(4, '\0');
}

TEST(ReadDepthImage, AllocatesNothingForTextsInPng) {
#ifndef RELIEVO_WATCHES_ALLOCATIONS
  GTEST_SKIP() << "sanitizers watch allocations on their own";
#endif
  const std::string good = as_string(write_png(grey16()));
  const std::size_t behind_header = 8 + 25;
  for (const char* type : {"tEXt", "zTXt", "iTXt", "sPLT", "sCAL", "pCAL", "iCCP", "quIt"}) {
    const std::string huge = std::string(good).insert(behind_header, png_chunk(type, 7'000'000, "a"));
    largest_allocation = 0;
    EXPECT_NE(image_message(huge), "no error") << type;
    EXPECT_GT(largest_allocation, 0U);
    EXPECT_LT(largest_allocation, 1'000'000U) << type;
    const std::string text =
        std::string(good).insert(behind_header, png_chunk(type, 5, std::string("a\0bcd", 5)));
    EXPECT_EQ(image_message(text), "no error") << type;
  }
}

}  // namespace
}  // namespace relievo
