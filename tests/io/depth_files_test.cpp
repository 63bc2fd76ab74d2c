// Depth images as files: PNG and TIFF, whole and broken.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <atomic>
#include <cstdlib>

#include "relievo/core/image.h"
#include "relievo/io/read.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"
#include "relievo/scan/depth_image.h"
#include "support/format_samples.h"
#include "support/read_text.h"
#include "support/results.h"

// The largest allocation of the test program and the libraries in it, which call this function in place of the system's.
// Sanitizers have one of their own.
static std::atomic<std::size_t> largest_allocation = 0;

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RELIEVO_WATCHES_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t bytes);  // NOLINT: the name is the library's
extern "C" void* malloc(std::size_t bytes) {
  if (bytes > largest_allocation) largest_allocation = bytes;
  return __libc_malloc(bytes);
}
#endif

namespace relievo {
namespace {

std::string message_of(const std::string& bytes) {
  return relievo::message_of(read_depth_image(bytes_of(bytes), "d"));
}

Image16 grey16() {
  Image16 image{5, 4, 1, {}};
  for (int i = 0; i < 20; ++i) image.pixels.push_back(static_cast<std::uint16_t>(3001 * i));
  return image;
}

// Little-endian, one strip of uint16, its fields in this order at 12 bytes each from byte 10 on.
std::string small_tiff() {
  const Image16 image = grey16();
  struct Field {
    std::uint16_t tag, type;
    std::uint32_t value;
  };
  const Field fields[] = {{256, 4, 5}, {257, 4, 4}, {258, 3, 16},
                          {259, 3, 1}, {262, 3, 1}, {273, 4, 8 + 2 + 9 * 12 + 4},
                          {277, 3, 1}, {278, 4, 4}, {279, 4, 40}};
  std::string file = std::string("II*\0", 4) + raw(std::uint32_t{8}) + raw(std::uint16_t{9});
  for (const Field& f : fields) file += raw(f.tag) + raw(f.type) + raw(std::uint32_t{1}) + raw(f.value);
  file += raw(std::uint32_t{0});
  for (const std::uint16_t v : image.pixels) file += raw(v);
  return file;
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
  EXPECT_EQ(
      message_of(as_string(write_png(colour))),
      "d, column 2, row 1: expected a grey picture of depths, found colours; the option channel takes one "
      "of them, and depth-values luminance their brightness");
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

TEST(ReadDepthImage, ReadsTiffOfIntegersAndFloats) {
  const auto whole = value_of(read_depth_image(bytes_of(small_tiff()), "d"));
  EXPECT_EQ(whole.format, "TIFF, 16 bits");
  EXPECT_EQ(whole.values[19], 3001.F * 19);
  HeightsMm heights{{5, 4, 1, {}}, .1};
  for (int i = 0; i < 20; ++i) heights.image.pixels.push_back(.25F * static_cast<float>(i));
  EXPECT_EQ(read_depth_image(write_tiff(heights), "d")->values.pixels, heights.image.pixels);
}

TEST(ReadDepthImage, BrokenPngFieldsAreNamed) {
  const std::string good = as_string(write_png(grey16()));
  const auto with = [&](std::size_t at, std::uint8_t byte) { return patched(good, at, byte); };
  const std::vector<std::pair<std::string, std::string>> all = {
      {good.substr(0, 20), "the end of the file"},
      {with(5, 0), "Not a PNG file"},
      {with(12, 'J'), "chunk type"},
      {with(16, 0x80), "IHDR"},
      {with(19, 0), "IHDR"},
      {with(23, 0), "IHDR"},
      {with(24, 5), "IHDR"},
      {with(25, 9), "IHDR"},
      {with(26, 1), "IHDR"},
      {with(28, 7), "IHDR"},
      {with(29, 0), "CRC"},
      {good.substr(0, good.size() - 20), "the end of the file"},
      {good.substr(0, good.size() - 12), "the end of the file"}};
  for (const auto& [text, part] : all) {
    const std::string message = message_of(text);
    EXPECT_TRUE(message.starts_with("d, byte ")) << message;
    EXPECT_TRUE(message.contains("expected the data of a PNG picture, found ")) << message;
  }
  EXPECT_EQ(message_of("GIF89a"), "d: expected a PNG or TIFF picture of depths, found another file");
  EXPECT_EQ(message_of(as_string(write_png(Image8{3, 4, 1, std::vector<std::uint8_t>(12)}))),
            "d: expected at least 4 x 4 pixels, found 3 x 4");
}

// A chunk of a PNG, whose length may be a lie; the checksum of skipped chunks is not looked at.
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
    EXPECT_NE(message_of(huge), "no error") << type;
    EXPECT_GT(largest_allocation, 0U);
    EXPECT_LT(largest_allocation, 1'000'000U) << type;
    const std::string text =
        std::string(good).insert(behind_header, png_chunk(type, 5, std::string("a\0bcd", 5)));
    EXPECT_EQ(message_of(text), "no error") << type;
  }
}

TEST(ReadDepthImage, BrokenTiffFieldsAreNamed) {
  const std::string good = small_tiff();
  const auto field = [](std::size_t i) { return 10 + 12 * i; };
  const std::string libtiff = ": expected the data of a TIFF picture; libtiff says: ";
  const std::vector<std::pair<std::string, std::string>> all = {
      {good.substr(0, 6), ", byte 0" + libtiff},
      {patched(good, 4, std::uint32_t{999999}),
       ", byte 4: expected the place of the picture's tags below 162, the size of the file, found 999999; "
       "the file is cut, get it anew"},
      {good.substr(0, 60), ", byte 8" + libtiff},
      {good.substr(0, good.size() - 10),
       ", strip 0: expected 40 bytes from byte 122 on, found 30; the file is cut, get it anew"},
      {patched(good, field(0) + 8, std::uint32_t{0}), ", byte 8" + libtiff},
      {patched(good, field(0) + 8, std::uint32_t{1} << 30), ": expected at most 134217728 pixels, found "},
      {patched(patched(good, field(1) + 8, std::uint32_t{1} << 26), field(7) + 8, std::uint32_t{1} << 26),
       ": expected at most 134217728 pixels, found 335544320"},
      {patched(good, field(2) + 8, std::uint32_t{48}),
       ": expected whole numbers of 1 to 32 or 64 bits, or fractions of 16, 32 or 64, found 48-bit whole "
       "numbers"},
      {patched(good, field(3) + 8, std::uint32_t{5}), ", strip 0" + libtiff},
      {patched(good, field(3) + 8, std::uint32_t{60000}), ", strip 0" + libtiff},
      {patched(good, field(5) + 8, std::uint32_t{99999}),
       ", strip 0: expected 40 bytes from byte 99999 on, found 0; the file is cut, get it anew"},
      {patched(good, field(6) + 8, std::uint32_t{3}),
       ": expected one channel of depths, found 3; the option channel takes one of them, and depth-values "
       "luminance their brightness"}};
  for (const auto& [text, begin] : all) EXPECT_EQ(message_of(text).substr(0, 1 + begin.size()), "d" + begin);
}

TEST(ReadDepthImage, AnyDamageGivesAnAnswer) {
  const std::vector<std::string> files = {as_string(write_png(grey16())), small_tiff(),
                                          as_string(write_tiff({{5, 4, 1, std::vector<float>(20, 1)}, .1}))};
  for (const std::string& file : files) {
    for (std::size_t size = 0; size < file.size(); ++size) (void)message_of(file.substr(0, size));
    for (std::size_t at = 0; at < file.size(); ++at)
      for (const auto byte : std::array<std::uint8_t, 3>{0x00, 0x7F, 0xFF}) {
        const auto image = read_depth_image(bytes_of(patched(file, at, byte)), "d");
        if (image) {
          EXPECT_EQ(image->values.size(), image->values.index(0, image->values.height));
        }
      }
  }
  ASSERT_TRUE(rc::check([&] {
    std::string text = *rc::gen::elementOf(files);
    const int edits = *rc::gen::inRange(1, 5);
    for (int i = 0; i < edits; ++i)
      text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
    const auto image = read_depth_image(bytes_of(text), "d");
    RC_ASSERT(image.has_value() || image.error().kind == ErrorKind::input);
  }));
}

}  // namespace
}  // namespace relievo
