// Tests JPEG pictures, as depth images and as textures.
#include "io/pictures/pictures.h"
#include "io/texture.h"
#include "support/format_samples.h"
#include "support/jpeg_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

constexpr int squares_across = 3, squares_down = 2;

// Returns levels that differ from square to square. They include the smallest and the largest level.
int level(int column, int row) {
  return 51 * (column + squares_across * row);
}

JpegSquares grey_squares() {
  JpegSquares picture{squares_across, squares_down, 1, {}};
  for (int i = 0; i < squares_across * squares_down; ++i)
    picture.squares.push_back({level(i % squares_across, i / squares_across) - 128});
  return picture;
}

// Returns a grey picture that has three equal channels instead of one. Many programs write grey pictures in
// this way.
JpegSquares grey_colours() {
  JpegSquares picture = grey_squares();
  picture.channels = 3;
  for (std::vector<int>& square : picture.squares) square.resize(3, 0);
  return picture;
}

JpegSquares one_colour(int y, int blue, int red) {
  return {1, 1, 3, {{y, blue, red}}};
}

// Returns an Exif segment whose second tag is the orientation.
std::string exif(int orientation, bool is_big_endian) {
  const auto number = [&](std::uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
      text += static_cast<char>(value >> 8 * (is_big_endian ? bytes - 1 - i : i));
    return text;
  };
  const auto entry = [&](std::uint32_t tag, std::uint32_t value) {
    return number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 2) + number(0, 2);
  };
  return jpeg::segment(0xE1, std::string("Exif\0\0", 6) + (is_big_endian ? "MM" : "II") + number(42, 2) +
                                 number(8, 4) + number(2, 2) + entry(256, 7) +
                                 entry(274, static_cast<std::uint32_t>(orientation)) + number(0, 4));
}

DepthImage image_of(const JpegSquares& picture) {
  return image_in(jpeg_of(picture));
}

void expect_levels(const DepthImage& image) {
  ASSERT_EQ(image.values.width, 8 * squares_across);
  ASSERT_EQ(image.values.height, 8 * squares_down);
  for (int y = 0; y < image.values.height; ++y)
    for (int x = 0; x < image.values.width; ++x) ASSERT_EQ(image.values.at(x, y), level(x / 8, y / 8));
}

TEST(DepthJpeg, HasTheLevelsOfItsSquares) {
  expect_levels(image_of(grey_squares()));
  expect_levels(image_of(grey_colours()));
  EXPECT_EQ(image_of(grey_squares()).step, 1);
  EXPECT_EQ(image_of(grey_squares()).format, "JPEG, 8 bits");
}

TEST(DepthJpeg, MayBeProgressive) {
  JpegSquares picture = grey_squares();
  picture.is_progressive = true;
  expect_levels(image_of(picture));
}

// The expected values follow the formulas of JFIF, with results rounded to integers as libjpeg does.
TEST(DepthJpeg, ColoursAreChannelsOrLuminance) {
  const int y = 100, blue = 40, red = -30;
  const std::string file = jpeg_of(one_colour(y - 128, blue, red));
  EXPECT_TRUE(
      image_message(file).starts_with("d, column 1, row 1: expected a grey picture of depths, found colours"))
      << image_message(file);
  const double channels[] = {y + 1.402 * red, y - .344136 * blue - .714136 * red, y + 1.772 * blue};
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(double{image_in(file, {false, c + 1}).values.at(4, 4)}, channels[c], .51);
  const double luminance = .2126 * channels[0] + .7152 * channels[1] + .0722 * channels[2];
  EXPECT_NEAR(double{image_in(file, {true}).values.at(4, 4)}, luminance, .51);
}

TEST(DepthJpeg, IsTurnedUpright) {
  const DepthImage stored = image_of(grey_squares());
  for (const bool is_big_endian : {false, true}) {
    JpegSquares picture = grey_squares();
    picture.segments = exif(6, is_big_endian);  // row 0 is the right edge, column 0 the top edge
    const DepthImage turned = image_of(picture);
    ASSERT_EQ(turned.values.width, stored.values.height);
    for (int y = 0; y < stored.values.height; ++y)
      for (int x = 0; x < stored.values.width; ++x)
        ASSERT_EQ(turned.values.at(stored.values.height - 1 - y, x), stored.values.at(x, y));
  }
}

TEST(DepthJpeg, SaysWhatIsNotRead) {
  JpegSquares prints = grey_squares();
  prints.channels = 4;
  for (std::vector<int>& square : prints.squares) square.resize(4, 0);
  const std::string file = jpeg_of(grey_squares());
  const std::size_t frame = file.find("\xFF\xC0");
  const auto of_size = [&](const char* size) { return std::string(file).replace(frame + 5, 4, size); };
  expect_image_messages(
      {{jpeg_of(prints),
        ": expected a JPEG picture of grey or of red, green and blue, found 4 channels, as CMYK of prints "
        "has; save it as PNG"},
       {"\xFF\xD8\xFF\xE0", ": expected the size of a JPEG picture, found none; save it as PNG"},
       {of_size("\xFF\xDC\xFF\xDC"), ": expected at most 134217728 pixels, found 65500 x 65500"},
       {of_size("\x20\x20\x20\x20"), cat(": expected more data for 67634176 pixels, found ", file.size(),
                                         " bytes; the file is cut, get it anew")}});
  std::string deep = file;
  deep[frame + 4] = '\x0C';
  EXPECT_TRUE(image_message(deep).ends_with(
      ": expected the data of a JPEG picture, found: Unsupported JPEG data precision 12"))
      << image_message(deep);
}

TEST(DepthJpeg, IsRefusedWhereItsPixelsAreCutOrBroken) {
  const std::string file = jpeg_of(grey_squares());
  for (std::size_t size = 0; size + 2 < file.size(); ++size)
    EXPECT_FALSE(read_image(file.substr(0, size)).has_value()) << size;
  EXPECT_EQ(image_message(file.substr(0, file.size() - 3)),
            cat("d, byte ", file.size() - 3,
                ": expected the data of a JPEG picture, found: Premature end of JPEG file"));
}

TEST(DepthJpeg, AnyDamagedByteGivesAnAnswer) {
  const std::string file = jpeg_of(grey_colours());
  for (std::size_t i = 3; i < file.size(); ++i)
    for (const int change : {1, 128, 255}) {
      std::string damaged = file;
      damaged[i] = static_cast<char>(damaged[i] ^ change);
      const auto image = read_image(damaged);
      EXPECT_TRUE(image.has_value() || image.error().kind == ErrorKind::input);
    }
}

// A picture may be divided into several scans. Decoding each of them takes as much time as decoding a whole picture.
TEST(DepthJpeg, HasAHundredScansAtMost) {
  JpegSquares picture = grey_squares();
  picture.is_progressive = true;
  const std::string file = jpeg_of(picture);
  const std::size_t scan = file.find("\xFF\xDA"), end = file.size() - 2;
  std::string many = file.substr(0, end);
  for (int i = 0; i < 120; ++i) many += file.substr(scan, end - scan);
  EXPECT_FALSE(read_image(many + "\xFF\xD9").has_value());
}

TEST(JpegHeader, IsFoundBehindOtherSegments) {
  JpegSquares picture = grey_colours();
  picture.segments = jpeg::segment(0xE0, "JFIF") + exif(3, true) + std::string("\xFF\xFF", 2) +
                     jpeg::segment(0xFE, std::string(70, '\xFF'));
  const std::string file = jpeg_of(picture);
  const io::JpegHeader header = io::find_jpeg_header(file);
  EXPECT_EQ(header.width, 8U * squares_across);
  EXPECT_EQ(header.height, 8U * squares_down);
  EXPECT_EQ(header.channels, 3U);
  EXPECT_EQ(header.orientation, 3);
  const ScanSize size = scan_size(bytes_of(file), "a.jpg", file.size());
  EXPECT_EQ(size.pixels, 64U * squares_across * squares_down);
  EXPECT_TRUE(size.is_stated);
  EXPECT_EQ(io::find_jpeg_header(file.substr(0, 40)).width, 0U);
}

TEST(Texture, MayBeAJpeg) {
  const auto texture = value_of(io::Texture::read(jpeg_of(one_colour(0, 0, 0)), "a.jpg"));
  EXPECT_EQ(texture.at(.5, .5), (Colour{128, 128, 128}));
  EXPECT_EQ(io::Texture::read(jpeg_of(grey_squares()), "a.jpg")->at(.5, .25), (Colour{51, 51, 51}));
}

}  // namespace
}  // namespace relievo
