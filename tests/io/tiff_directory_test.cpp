// Tests the tags of a TIFF that say which of its pictures counts, how this picture is oriented, and how
// large its pixels are.
#include <array>

#include "support/read_text.h"
#include "support/tiff_encoder.h"

namespace relievo {
namespace {

// A tag to add to whole_tiff(). Added tags follow the other tags. Their numbers are stored after the picture.
struct ExtraTag {
  std::uint16_t tag, type;
  std::uint32_t count;
  std::string numbers;
};

std::string with_tags(const std::vector<ExtraTag>& extra) {
  const std::string whole = whole_tiff();
  constexpr std::size_t tags = 10, directory = 10, end_of_tags = directory + 12 * tags;
  const auto added = static_cast<std::uint32_t>(12 * extra.size());
  std::string file = whole.substr(0, end_of_tags), data = whole.substr(end_of_tags);
  file = patched(file, 8, static_cast<std::uint16_t>(tags + extra.size()));
  file = patched(file, directory + 12 * 5 + 8, static_cast<std::uint32_t>(end_of_tags + added + 4));
  const std::size_t behind = whole.size() + added;
  std::string numbers;
  for (const ExtraTag& tag : extra) {
    const bool fits = tag.numbers.size() <= 4;
    file += raw(tag.tag) + raw(tag.type) + raw(tag.count);
    file += fits ? padded(tag.numbers, '\0') : raw(static_cast<std::uint32_t>(behind + numbers.size()));
    if (!fits) numbers += tag.numbers;
  }
  return file + data + numbers;
}

// The orientation says which edges of the picture are the first row and the first column of the file (tag 274
// of TIFF 6.0).
TEST(TiffDirectory, FollowsTheOrientation) {
  const auto at = [](int x, int y) { return static_cast<float>(width * y + x); };  // stored values
  const int last_x = width - 1, last_y = height - 1;
  const std::array<std::array<float, 3>, 8> corners = {{
      // the values at top left, top right and bottom left
      {at(0, 0), at(last_x, 0), at(0, last_y)},
      {at(last_x, 0), at(0, 0), at(last_x, last_y)},
      {at(last_x, last_y), at(0, last_y), at(last_x, 0)},
      {at(0, last_y), at(last_x, last_y), at(0, 0)},
      {at(0, 0), at(0, last_y), at(last_x, 0)},
      {at(0, last_y), at(0, 0), at(last_x, last_y)},
      {at(last_x, last_y), at(last_x, 0), at(0, last_y)},
      {at(last_x, 0), at(last_x, last_y), at(0, 0)},
  }};
  for (std::uint16_t orientation = 0; orientation <= 9; ++orientation) {
    std::string file = whole_tiff();
    // The orientation tag replaces the tag SamplesPerPixel, whose default is 1.
    file = patched(patched(file, 10 + 12 * 6, std::uint16_t{274}), 10 + 12 * 6 + 8, orientation);
    const auto image = image_in(file).values;
    const bool is_turned = orientation >= 5 && orientation <= 8;
    ASSERT_EQ(image.width, is_turned ? height : width) << orientation;
    ASSERT_EQ(image.height, is_turned ? width : height) << orientation;
    const auto& [top_left, top_right, bottom_left] =
        corners[orientation >= 1 && orientation <= 8 ? orientation - 1U : 0];
    EXPECT_EQ(image.at(0, 0), top_left) << orientation;
    EXPECT_EQ(image.at(image.width - 1, 0), top_right) << orientation;
    EXPECT_EQ(image.at(0, image.height - 1), bottom_left) << orientation;
  }
}

template <typename T>
std::string all_raw(std::initializer_list<T> values) {
  std::string bytes;
  for (const T v : values) bytes += raw(v);
  return bytes;
}

Vec2 pixel_size_of(const std::vector<ExtraTag>& tags) {
  return image_in(with_tags(tags)).pixel_size;
}

TEST(TiffDirectory, TakesTheSizeOfPixelsFromGeoTiff) {
  const ExtraTag scale{33550, 12, 3, all_raw<double>({30, 20, 0})};
  EXPECT_EQ(pixel_size_of({}), Vec2(0, 0));
  EXPECT_EQ(pixel_size_of({scale}), Vec2(30, 20));
  const auto keys = [](std::uint16_t key, std::uint16_t value) {
    return ExtraTag{34735, 3, 8, all_raw<std::uint16_t>({1, 1, 0, 1, key, 0, 1, value})};
  };
  EXPECT_LT((pixel_size_of({scale, keys(3076, 9002)}) - .3048 * Vec2(30, 20)).norm(), 1e-12);
  // The matrix rotates the picture by 90 degrees: the next column lies 30 lower, and the next row lies 20
  // farther to the right.
  const ExtraTag matrix{34264, 12, 16, all_raw<double>({0, 20, 0, 7, -30, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 1})};
  EXPECT_EQ(pixel_size_of({matrix}), Vec2(30, 20));
  EXPECT_EQ(pixel_size_of({{33550, 11, 3, raw(1.F) + raw(2.F) + raw(0.F)}}), Vec2(0, 0)) << "not doubles";
  EXPECT_EQ(pixel_size_of({{33550, 12, 3, all_raw<double>({1, 1000, 0})}}), Vec2(0, 0))
      << "out of proportion";
  EXPECT_EQ(pixel_size_of({{33550, 12, 3, all_raw<double>({-1, 1, 0})}}), Vec2(0, 0));
}

// At 60 degrees north, a degree of longitude is half as long as a degree of latitude, which is 111 km.
TEST(TiffDirectory, ConvertsDegreesAtTheMiddleRow) {
  const ExtraTag scale{33550, 12, 3, all_raw<double>({.5, .5, 0})},
      tie{33922, 12, 6,
          all_raw<double>({0, 0, 0, 10, 61, 0})},  // the upper edge; the middle row is 2 pixels lower
      keys{34735, 3, 8, all_raw<std::uint16_t>({1, 1, 0, 1, 1024, 0, 1, 2})};
  const Vec2 size = pixel_size_of({scale, tie, keys});
  EXPECT_NEAR(size.x() / size.y(), .5, 1e-12);
  EXPECT_NEAR(size.y(), .5 * 111195, 1);
}

// Returns a file with both pictures. The directory of the first picture refers to the directory of the second.
std::string two_pictures(std::string first, const std::string& second) {
  const std::size_t end_of_tags = 10 + 12 * 10, begin = first.size();
  first = patched(first, end_of_tags, static_cast<std::uint32_t>(begin));
  std::string moved = second.substr(8);  // the second file without its header
  const auto by = static_cast<std::uint32_t>(begin - 8);
  moved = patched(moved, 2 + 12 * 5 + 8, static_cast<std::uint32_t>(end_of_tags + 4 + by));
  return first + moved;
}

TEST(TiffDirectory, SkipsThumbnailsAndMasks) {
  const std::string whole = whole_tiff();
  const std::string other = tiff_of({}, pixels_of([](int i) { return static_cast<std::uint16_t>(100 + i); }));
  const auto first_value = [&](std::uint32_t kind_of_first, std::uint32_t kind_of_second) {
    const auto with_kind = [](std::string file, std::uint32_t kind) {  // replaces the tag SamplesPerPixel
      return patched(patched(file, 10 + 12 * 6, std::uint16_t{254}), 10 + 12 * 6 + 8, kind);
    };
    const std::string file = two_pictures(with_kind(whole, kind_of_first), with_kind(other, kind_of_second));
    return image_in(file).values[0];
  };
  EXPECT_EQ(first_value(0, 0), 0);
  EXPECT_EQ(first_value(1, 0), 100);
  EXPECT_EQ(first_value(4, 2), 100);
  EXPECT_EQ(first_value(1, 1), 0);
}

TEST(TiffDirectory, SaysThatThereIsNoPicture) {
  expect_image_messages({{std::string("II*\0", 4) + std::string(12, '\0'),
                          ", byte 4: expected the place of the picture's tags, found 0; the file has no "
                          "picture, save it anew"}});
}

}  // namespace
}  // namespace relievo
