// Tests TIFF pictures with numbers of every type that cameras, terrain models and microscopes write.
#include <functional>

#include "support/read_text.h"
#include "support/tiff_encoder.h"

namespace relievo {
namespace {

Result<DepthImage> read_tiff(const TiffTags& tags, const std::string& pixels,
                             const PictureChannels& channels = {}) {
  return read_image(tiff_of(tags, pixels), channels);
}

// Returns the file with `value` in each of the given fields. The fields are counted from 0.
std::string with_field(std::string file, std::initializer_list<std::size_t> fields, std::uint32_t value) {
  for (const std::size_t i : fields) file = patched(file, 10 + 12 * i + 8, value);
  return file;
}

// Expects that pixel i of the picture has the value expected(i).
void expect_values(const TiffTags& tags, const std::string& pixels,
                   const std::function<double(int)>& expected) {
  const auto image = value_of(read_tiff(tags, pixels));
  EXPECT_EQ(image.format, "TIFF, " + std::to_string(tags.bits) + " bits");
  EXPECT_EQ(image.step, tags.kind == 3 ? 0 : 1);
  for (int i = 0; i < width * height; ++i)
    EXPECT_EQ(image.values[static_cast<std::size_t>(i)], static_cast<float>(expected(i)))
        << tags.bits << ", " << i;
}

TEST(DepthTiff, ReadsNumbersOfAllWholeBytes) {
  expect_values({8, 2}, pixels_of([](int i) { return static_cast<std::int8_t>(i - 9); }),
                [](int i) { return i - 9; });
  expect_values({16, 2}, pixels_of([](int i) { return static_cast<std::int16_t>(-900 * i); }),
                [](int i) { return -900 * i; });
  expect_values({32, 1}, pixels_of([](int i) { return 200'000'000U * static_cast<unsigned>(i); }),
                [](int i) { return 2e8 * i; });
  expect_values({32, 2}, pixels_of([](int i) { return -100000 * i; }), [](int i) { return -1e5 * i; });
  expect_values({64, 1}, pixels_of([](int i) { return std::uint64_t{1} << (3 * i); }),
                [](int i) { return std::exp2(3 * i); });
  expect_values({64, 2}, pixels_of([](int i) { return -(std::int64_t{1} << (3 * i)); }),
                [](int i) { return -std::exp2(3 * i); });
  expect_values({8, 4}, pixels_of([](int i) { return static_cast<std::uint8_t>(12 * i); }),
                [](int i) { return 12 * i; });
}

TEST(DepthTiff, ReadsFractions) {
  expect_values({64, 3}, pixels_of([](int i) { return 1 / (1. + i); }), [](int i) { return 1 / (1. + i); });
  expect_values({32, 3}, pixels_of([](int i) { return .25F * static_cast<float>(i); }),
                [](int i) { return .25 * i; });
  // Half-precision numbers have 10 bits of fraction. The stored exponent 15 means 2^0.
  expect_values({16, 3}, pixels_of([](int i) { return static_cast<std::uint16_t>(i << 10 | 512); }),
                [](int i) { return i == 0 ? std::ldexp(512, -24) : std::ldexp(1.5, i - 15); });
  const auto special = read_tiff({16, 3}, pixels_of([](int i) {
                                   constexpr std::uint16_t all[] = {0x7C00, 0xFC00, 0x7E00, 0x8000, 0xC000};
                                   return all[i % 5];
                                 }));
  ASSERT_TRUE(special);
  EXPECT_EQ(special->values[0], HUGE_VALF);
  EXPECT_EQ(special->values[1], -HUGE_VALF);
  EXPECT_TRUE(std::isnan(special->values[2]));
  EXPECT_EQ(special->values[3], 0);
  EXPECT_EQ(special->values[4], -2);
}

// Terrain models store the lowest floating-point number where the height is unknown. Some of them have no
// tag that says so.
TEST(DepthTiff, TakesTheLowestFractionForNone) {
  const auto image = read_tiff({32, 3}, pixels_of([](int i) {
                                 constexpr float all[] = {-3.4028235e38F, -3.4e38F, -9999, 7};
                                 return all[i % 4];
                               }));
  ASSERT_TRUE(image);
  EXPECT_TRUE(std::isnan(image->values[0]) && std::isnan(image->values[1]));
  EXPECT_EQ(image->values[2], -9999);
  EXPECT_EQ(image->values[3], 7);
}

// Each row of packed numbers begins at a byte. The most significant bit of a number comes first.
TEST(DepthTiff, ReadsPackedNumbers) {
  for (const std::uint32_t bits : {1U, 2U, 3U, 4U, 7U, 9U, 10U, 12U, 14U, 17U, 20U, 31U}) {
    const auto number = [&](int i) {
      return ((std::uint64_t{1} << (bits - 1)) + 7 * static_cast<unsigned>(i)) % (std::uint64_t{1} << bits);
    };
    std::string pixels;
    for (int row = 0; row < height; ++row) {
      std::string line((width * bits + 7) / 8, '\0');
      for (std::size_t bit = 0; bit < width * bits; ++bit) {
        const auto i = row * width + static_cast<int>(bit / bits);
        if (number(i) >> (bits - 1 - bit % bits) & 1)
          line[bit / 8] = static_cast<char>(line[bit / 8] | 128 >> bit % 8);
      }
      pixels += line;
    }
    expect_values({bits, 1}, pixels, [&](int i) { return static_cast<double>(number(i)); });
  }
  std::string pixels;
  for (int i = 0; i < width * height; ++i)
    pixels += raw(std::uint32_t{70000} * static_cast<unsigned>(i)).substr(0, 3);
  expect_values({24, 1}, pixels, [](int i) { return 70000. * i; });
}

TEST(DepthTiff, TransparentPixelsAreMissing) {
  std::string pixels;
  for (int i = 0; i < width * height; ++i)
    pixels += raw(static_cast<std::uint16_t>(i)) + raw(static_cast<std::uint16_t>(i % 3 ? 32768 : 32767));
  const auto image = value_of(read_tiff({16, 1, 2}, pixels));
  for (int i = 0; i < width * height; ++i) {
    const float value = image.values[static_cast<std::size_t>(i)];
    EXPECT_TRUE(i % 3 ? value == static_cast<float>(i) : std::isnan(value)) << i;
  }
  // If the second channel is requested, the values are those of this channel.
  EXPECT_EQ(value_of(read_tiff({16, 1, 2}, pixels, {false, 2})).values[0], 32767);
}

TEST(DepthTiff, TakesOneOfSeveralChannelsOrTheirLuminance) {
  const TiffTags tags{16, 1, 3, 2};
  std::string pixels;
  for (int i = 0; i < width * height; ++i)
    pixels += raw(static_cast<std::uint16_t>(i)) + raw(static_cast<std::uint16_t>(1000 + i)) +
              raw(static_cast<std::uint16_t>(60000 - i));
  const auto second = value_of(read_tiff(tags, pixels, {false, 2})),
             bright = value_of(read_tiff(tags, pixels, {true}));
  for (int i = 0; i < width * height; ++i) {
    EXPECT_EQ(second.values[static_cast<std::size_t>(i)], static_cast<float>(1000 + i));
    EXPECT_NEAR(bright.values[static_cast<std::size_t>(i)],
                .2126 * i + .7152 * (1000 + i) + .0722 * (60000 - i), .01);
  }
  expect_image_messages({{tiff_of(tags, pixels),
                          ": expected one channel of depths, found 3; the option channel takes one of them, "
                          "and depth-values luminance their brightness"}});
  EXPECT_EQ(read_tiff(tags, pixels, {false, 4}).error().message(),
            "d: expected a channel from 1 to 3, found 4");
}

TEST(DepthTiff, EqualColoursAreGrey) {
  std::string pixels;
  for (int i = 0; i < width * height; ++i)
    for (int c = 0; c < 3; ++c) pixels += raw(static_cast<std::uint16_t>(100 * i));
  expect_values({16, 1, 3, 2}, pixels, [](int i) { return 100 * i; });
  pixels.back() = '\x7F';
  expect_error(read_tiff({16, 1, 3, 2}, pixels), "expected one channel of depths, found 3");
}

TEST(DepthTiff, InvertsWhereZeroIsWhite) {
  const std::string pixels = pixels_of([](int i) { return static_cast<std::uint16_t>(i); });
  expect_values({16, 1, 1, 0}, pixels, [](int i) { return 65535 - i; });
}

TEST(DepthTiff, LeavesOutWhatGdalStatesAsNoData) {
  const std::string pixels = pixels_of([](int i) { return i % 3 ? .5F : -3.4028234663852886e+38F; });
  const auto image = value_of(read_tiff({32, 3, 1, 1, "-3.4028234663852886e+38"}, pixels));
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (i % 3 == 0)
      EXPECT_TRUE(std::isnan(image.values[i])) << i;
    else
      EXPECT_EQ(image.values[i], .5F);
  }
  const auto whole = value_of(read_tiff(
      {16, 2, 1, 1, " -9999 "}, pixels_of([](int i) { return static_cast<std::int16_t>(i ? i : -9999); })));
  EXPECT_TRUE(std::isnan(whole.values[0]));
  EXPECT_EQ(whole.values[1], 1);
  expect_values({16, 1, 1, 1, "abc"}, pixels_of([](int i) { return static_cast<std::uint16_t>(i); }),
                [](int i) { return i; });
}

TEST(DepthTiff, NamesWhatItDoesNotRead) {
  const auto file = [](const TiffTags& tags) { return tiff_of(tags, std::string(width * height * 8, '\1')); };
  const std::string grey = ": expected a grey picture of depths, found ",
                    numbers =
                        ": expected whole numbers of 1 to 32 or 64 bits, or fractions of 16, 32 or 64, "
                        "found ",
                    pixels = ": expected at most 134217728 pixels, found ";
  expect_image_messages(
      {{file({8, 1, 1, 3}), grey + "a palette; save it in shades of grey"},
       {file({16, 2, 1, 32844}), grey + "logarithms of brightness; save it in shades of grey"},
       {file({48, 1}), numbers + "48-bit whole numbers"},
       {file({24, 3}), numbers + "24-bit fractions"},
       {file({64, 6}), numbers + "64-bit complex numbers"},
       {with_field(whole_tiff(), {1, 7}, 1U << 26), pixels + "335544320"}});
  EXPECT_TRUE(image_message(with_field(whole_tiff(), {0}, 1U << 30)).starts_with("d" + pixels));
}

// Returns a picture of 40 x 24 numbers of 16 bits, in 3 x 2 tiles of 16 x 16 numbers. The number in column x
// and row y is 100 y + x. Numbers of tiles outside the picture are 7.
std::string tiled_tiff(std::uint32_t tile_width) {
  constexpr std::uint32_t columns = 40, rows = 24, side = 16, tiles = 6, tile_bytes = 2 * side * side;
  const std::uint32_t data = 8 + 2 + 11 * 12 + 4;
  const TiffField fields[] = {{256, 4, 1, columns},    {257, 4, 1, rows},
                              {258, 3, 1, 16},         {259, 3, 1, 1},
                              {262, 3, 1, 1},          {277, 3, 1, 1},
                              {322, 4, 1, tile_width}, {323, 4, 1, side},
                              {324, 4, tiles, data},   {325, 4, tiles, data + 4 * tiles},
                              {339, 3, 1, 1}};
  std::string file = std::string("II*\0", 4) + raw(std::uint32_t{8}) + raw(std::uint16_t{11});
  for (const TiffField& f : fields) file += raw(f.tag) + raw(f.type) + raw(f.count) + raw(f.value);
  file += raw(std::uint32_t{0});
  for (std::uint32_t t = 0; t < tiles; ++t) file += raw(data + 8 * tiles + t * tile_bytes);
  for (std::uint32_t t = 0; t < tiles; ++t) file += raw(tile_bytes);
  for (std::uint32_t t = 0; t < tiles; ++t)
    for (std::uint32_t i = 0; i < side * side; ++i) {
      const std::uint32_t x = t % 3 * side + i % side, y = t / 3 * side + i / side;
      file += raw(static_cast<std::uint16_t>(x < columns && y < rows ? 100 * y + x : 7));
    }
  return file;
}

TEST(DepthTiff, ReadsTiles) {
  const auto image = image_in(tiled_tiff(16));
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 40; ++x)
      ASSERT_EQ(image.values.at(x, y), static_cast<float>(100 * y + x)) << x << ", " << y;
}

TEST(DepthTiff, CutFilesAreNamedWithThePlace) {
  const std::string whole = whole_tiff();
  const std::string tiled = tiled_tiff(16), cut = "; the file is cut, get it anew";
  expect_image_messages(
      {{whole.substr(0, whole.size() - 10),
        cat(", strip 0: expected 40 bytes from byte ", whole.size() - 40, " on, found 30", cut)},
       {with_field(whole, {5}, 99999), ", strip 0: expected 40 bytes from byte 99999 on, found 0" + cut},
       {tiled.substr(0, tiled.size() - 1),
        cat(", tile 5: expected 512 bytes from byte ", tiled.size() - 512, " on, found 511", cut)}});
  // Some programs write the tags after the picture. If such a file is cut, the tags are missing, and its
  // header refers to a position after the file's end.
  for (const auto& [begin, place] : {std::pair{std::string("II*\0\x20\x1\0\0", 8), "byte 4"},
                                     {std::string("MM\0*\0\0\x1\x20", 8), "byte 4"},
                                     {std::string("II+\0\x8\0\0\0\x20\x1\0\0\0\0\0\0", 16), "byte 8"}})
    expect_image_messages({{padded(begin + std::string(200 - begin.size(), '\7'), '\7'),
                            cat(", ", place,
                                ": expected the place of the picture's tags below 200, the size "
                                "of the file, found 288",
                                cut)}});
}

TEST(DepthTiff, SaysWhatLibtiffSays) {
  const std::string whole = whole_tiff();
  for (const auto& [file, place] : {std::pair{whole.substr(0, 6), "byte 0"},
                                    {whole.substr(0, 60), "byte 8"},
                                    {with_field(whole, {0}, 0), "byte 8"},
                                    {with_field(whole, {3}, 5), "strip 0"},
                                    {with_field(whole, {3}, 60000), "strip 0"},
                                    {tiled_tiff(0), "byte 8"}}) {
    const std::string message = image_message(file),
                      begin = cat("d, ", place, ": expected the data of a TIFF picture; libtiff says: ");
    EXPECT_TRUE(message.starts_with(begin) && message.size() > begin.size()) << message;
    EXPECT_FALSE(message.contains("picture: ")) << message;
    EXPECT_FALSE(message.ends_with("...")) << message;
  }
}

}  // namespace
}  // namespace relievo
