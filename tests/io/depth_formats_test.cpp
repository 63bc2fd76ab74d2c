// Tests pictures in uncompressed formats: NumPy arrays, portable pixmaps (PNM) and BMP.
#include <rapidcheck.h>

#include <bit>

#include "relievo/io/write.h"
#include "support/read_text.h"
#include "support/tiff_encoder.h"

namespace relievo {
namespace {

constexpr int columns = 6, rows = 5;

// Returns the bytes of all values. value(column, row) returns the bytes of a single value.
template <typename F>
std::string values(F value, bool is_by_columns = false) {
  std::string data;
  for (int i = 0; i < rows * columns; ++i)
    data += is_by_columns ? value(i / rows, i % rows) : value(i % columns, i / columns);
  return data;
}

double number(int column, int row) {
  return 10 * row + column;
}

void expect_numbers(const DepthImage& image, double step) {
  ASSERT_EQ(image.values.width, columns);
  ASSERT_EQ(image.values.height, rows);
  EXPECT_EQ(image.step, step);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) EXPECT_EQ(image.values.at(c, r), static_cast<float>(number(c, r)));
}

template <typename T>
std::string in_type(int column, int row) {
  return raw(static_cast<T>(number(column, row)));
}

TEST(DepthNpy, ReadsAllNumbersInBothOrders) {
  expect_numbers(image_in(npy("<f4", values(in_type<float>))), 0);
  expect_numbers(image_in(npy("<f8", values(in_type<double>))), 0);
  expect_numbers(image_in(npy("|u1", values(in_type<std::uint8_t>))), 1);
  expect_numbers(image_in(npy("|i1", values(in_type<std::int8_t>))), 1);
  expect_numbers(image_in(npy("<u2", values(in_type<std::uint16_t>))), 1);
  expect_numbers(image_in(npy("<i8", values(in_type<std::int64_t>))), 1);
  expect_numbers(image_in(npy("<f4", values(in_type<float>, true), "5, 6", true)), 0);
  expect_numbers(image_in(npy("<f4", values(in_type<float>), "1, 5, 6, 1", false, 2)), 0);
  const auto swapped = [](int c, int r) {
    return raw(std::byteswap(std::bit_cast<std::uint32_t>(static_cast<float>(number(c, r)))));
  };
  expect_numbers(image_in(npy(">f4", values(swapped))), 0);
  const auto half = [](int c, int r) { return raw(static_cast<std::uint16_t>(c == 0 ? 0 : 0x3C00 + r)); };
  const auto halves = image_in(npy("<f2", values(half)));
  EXPECT_EQ(halves.values.at(1, 2), 1 + 2 / 1024.F);
  EXPECT_EQ(halves.format, "NPY, 16 bits");
}

TEST(DepthNpy, SaysWhichArraysAreNoPictures) {
  const std::string whole = npy("<f4", values(in_type<float>)),
                    shape = ": expected an array of rows and columns, found the shape (";
  expect_image_messages(
      {{npy("<c8", ""),
        ": expected an array of numbers, found the type '<c8'; in Python astype('float32') converts it"},
       {npy("[('x', '<f4'), ('y', '<f4'), ('z', '<f4')]", ""),
        ": expected an array of numbers, found records; in Python np.stack([a['x'], a['y'], a['z']], -1) is "
        "an array of points"},
       {npy("|u1", "", "5, 6, 3"), shape + "5, 6, 3); in Python a[..., 0] is one of its channels"},
       {npy("<f4", "", "3, 5, 6"),
        shape + "3, 5, 6); in Python np.moveaxis(a, 0, -1) makes points of it, and a[0] is one of its "
                "channels"},
       {npy("<f4", "", ""), ": expected an array with rows, found the shape ()"},
       {whole.substr(0, 9), ", byte 8: expected the header of an array, found the end of the file"},
       {whole.substr(0, whole.size() - 1),
        cat(", byte ", whole.size() - 120,
            ": expected 120 bytes of pixels, found 119; the file is cut, get it anew")},
       {npy("<f4", "", "100000, 100000"), ": expected at most 134217728 pixels, found 100000 x 100000"}});
}

// The rows of a PFM start at the bottom. The sign of the last number of its header gives the byte order.
TEST(DepthPnm, ReadsFractionsFromBelow) {
  const auto from_below = [](int c, int r) { return raw(static_cast<float>(number(c, rows - 1 - r))); };
  expect_numbers(image_in("Pf\n6 5\n-1.0\n" + values(from_below)), 0);
  const auto swapped = [](int c, int r) {
    return raw(std::byteswap(std::bit_cast<std::uint32_t>(static_cast<float>(number(c, rows - 1 - r)))));
  };
  expect_numbers(image_in("Pf\n# of a depth estimator\n6\n5 1.0\n" + values(swapped)), 0);
  const auto grey = [&](int c, int r) { return from_below(c, r) + from_below(c, r) + from_below(c, r); };
  expect_numbers(image_in("PF\n6 5\n-1.0\n" + values(grey)), 0);
}

TEST(DepthPnm, ReadsWholeNumbersFromAbove) {
  expect_numbers(image_in("P5\n6 5\n255\n" + values(in_type<std::uint8_t>)), 1);
  const auto big_endian = [](int c, int r) {
    return raw(std::byteswap(static_cast<std::uint16_t>(number(c, r))));
  };
  expect_numbers(image_in("P5 6 5 65535\n" + values(big_endian)), 1);
  const auto colours = [](int c, int r) { return std::string{static_cast<char>(number(c, r)), '\1', '\2'}; };
  const std::string file = "P6\n6 5\n255\n" + values(colours);
  EXPECT_TRUE(image_message(file).starts_with("d, column 1, row 1: expected a grey picture of depths"))
      << image_message(file);
  expect_numbers(image_in(file, {false, 1}), 1);
}

TEST(DepthPnm, ReadsNumbersInText) {
  const auto word = [](int c, int r) { return cat(number(c, r), c == 3 ? " # a comment\n" : "\t"); };
  expect_numbers(image_in("P2\n# by hand\n6 5\n54\n" + values(word)), 1);
  const auto grey = [&](int c, int r) {
    return cat(number(c, r), " ", number(c, r), "\n", number(c, r), " ");
  };
  expect_numbers(image_in("P3 # colours\n6\n5 255 " + values(grey)), 1);
  EXPECT_EQ(image_in("P2\n6 5\n300\n" + values(word)).format, "PNM, 16 bits");
  EXPECT_TRUE(
      image_message("P2\n6 5\n44\n" + values(word)).ends_with(": expected a number up to 44, found '45'"));
  expect_image_messages(
      {{"P2\n4 4\n9\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6",
        ": expected 16 numbers, found 15; the file is cut, get it anew"},
       {"P2\n4 4\n9\n1 2 3 4 5 -6 7 8 9", ", byte 19: expected a number up to 9, found '-6'"}});
}

TEST(DepthPnm, SaysWhatIsWrong) {
  expect_image_messages(
      {{"Pf\nx 5\n-1\n\1", ", byte 3: expected width, height and range of the picture, found 'x'"},
       {"Pf\n0 5\n-1\n\1", ", byte 2: expected width and height, found 0 and 5"},
       {"P5\n6 5\n70000\n\1", ": expected a largest value from 1 to 65535, found 70000"},
       {"P5\n6 5\n255\n\1",
        ", byte 11: expected 30 bytes of pixels, found 1; the file is cut, get it anew"}});
  EXPECT_FALSE(is_picture(bytes_of("P5 10 20 30\nP6 40 50 60\n"))) << "a cloud of named points";
  EXPECT_FALSE(is_picture(bytes_of("P2 10 20 30\nP3 40 50 60\n"))) << "a cloud of named points";
}

// Returns a BMP with the given number of bits per pixel. The number of bytes in a row must be a multiple of 4.
std::string bmp(int bits, std::int32_t height, const std::string& palette, const std::string& data,
                std::uint32_t compression = 0) {
  const std::uint32_t pixels = 14 + 40 + static_cast<std::uint32_t>(palette.size());
  return "BM" + raw(std::uint32_t{0}) + raw(std::uint32_t{0}) + raw(pixels) + raw(std::uint32_t{40}) +
         raw(std::int32_t{columns}) + raw(height) + raw(std::uint16_t{1}) +
         raw(static_cast<std::uint16_t>(bits)) + raw(compression) + std::string(20, '\0') + palette + data;
}

TEST(DepthBmp, ReadsPalettesAndColoursFromBothSides) {
  std::string palette, bytes, colours, from_above;
  for (int i = 0; i < 256; ++i) palette += std::string(3, static_cast<char>(i)) + '\0';
  for (int r = rows - 1; r >= 0; --r) {
    for (int c = 0; c < columns; ++c) bytes += static_cast<char>(number(c, r));
    bytes += std::string(2, '\0');
    for (int c = 0; c < columns; ++c) colours += std::string(3, static_cast<char>(number(c, r)));
    colours += std::string(2, '\0');
  }
  for (int i = 0; i < rows * columns; ++i)
    from_above += std::string(3, static_cast<char>(number(i % columns, i / columns))) + '\0';
  expect_numbers(image_in(bmp(8, rows, palette, bytes)), 1);
  expect_numbers(image_in(bmp(24, rows, "", colours)), 1);
  expect_numbers(image_in(bmp(32, -rows, "", from_above)), 1);
  const std::string two = std::string(4, '\0') + std::string(3, '\xFF') + '\0';
  const auto bits = image_in(bmp(1, rows, two, std::string(4 * rows, '\x50')));  // 0101
  for (int c = 0; c < 4; ++c) EXPECT_EQ(bits.values.at(c, 0), c % 2 ? 255 : 0);
}

TEST(DepthBmp, SaysWhatIsNotRead) {
  expect_image_messages(
      {{bmp(8, rows, "", "", 1),
        ": expected a BMP of 1, 4, 8, 24 or 32 bits without compression, found 8 bits with compression; save "
        "it as PNG"},
       {bmp(24, 0, "", ""), ", byte 18: expected width and height, found 6 and 0"},
       {bmp(24, rows, "", "ab"),
        ", byte 54: expected 100 bytes of pixels, found 2; the file is cut, get it anew"}});
}

TEST(DepthFormats, AnyDamageGivesAnAnswer) {
  const std::vector<std::string> files = {as_string(write_png(filled_image<std::uint16_t>(5, 4, 3001))),
                                          as_string(write_tiff({filled_image(5, 4, 1.F), .1})),
                                          whole_tiff(),
                                          npy("<f4", values(in_type<float>)),
                                          "Pf\n6 5\n-1\n" + values(in_type<float>),
                                          "P5\n6 5\n255\n" + values(in_type<std::uint8_t>),
                                          "P2\n6 5\n9\n" + std::string(60, '7'),
                                          "P3\n4 4\n9\n" + replaced(std::string(48, '7'), "7", "7 "),
                                          bmp(32, -rows, "", std::string(4 * rows * columns, '\x7F'))};
  const auto is_answered = [](const std::string& text) {
    const auto image = read_image(text);
    return image ? image->values.size() == image->values.index(0, image->values.height)
                 : image.error().kind == ErrorKind::input;
  };
  for (const std::string& file : files)
    for (std::size_t at = 0; at < file.size(); ++at) {
      EXPECT_TRUE(is_answered(file.substr(0, at)));
      for (const char byte : {'\0', '\x7F', '\xFF'}) EXPECT_TRUE(is_answered(patched(file, at, byte)));
    }
  ASSERT_TRUE(rc::check([&] {
    std::string text = *rc::gen::elementOf(files);
    const std::size_t most = std::min(text.size(), *rc::gen::element<std::size_t>(90, 1000));
    const int edits = *rc::gen::inRange(1, 5);
    for (int i = 0; i < edits; ++i)
      text[*rc::gen::inRange<std::size_t>(0, most)] = *rc::gen::arbitrary<char>();
    RC_ASSERT(is_answered(text));
  }));
}

}  // namespace
}  // namespace relievo
