// Tests the readers of PCD and LAS: the clouds that they return, and their messages about broken fields.
#include <bit>
#include <charconv>

#include "support/format_samples.h"
#include "support/read_text.h"

namespace relievo {
namespace {

TEST(Pcd, EveryEncodingGivesTheSamePoints) {
  const std::vector<std::pair<std::string, std::string>> all = {
      {ascii_pcd(), "PCD ascii"}, {binary_pcd(), "PCD binary"}, {compressed_pcd(), "PCD binary compressed"}};
  for (const auto& [text, format] : all) {
    const auto file = file_of(text, "scan");
    EXPECT_EQ(file.format, format);
    EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{0, .5, 0}, {1, 1.5, -1}, {2, 2.5, -2}})) << format;
    EXPECT_EQ(file.cloud.normals, (std::vector<Vec3f>{Vec3f::UnitX(), Vec3f::UnitY(), Vec3f::UnitZ()}));
    EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}})) << format;
  }
}

TEST(Pcd, ColoursMayBeTheBitsOfAFloat) {
  const std::string head =
      "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "POINTS 1\nDATA ascii\n";
  std::array<char, 32> digits = {};
  std::to_chars(digits.data(), digits.data() + digits.size(), std::bit_cast<float>(0x00FF00FF));
  const auto file = file_of(head + "1 2 3 " + digits.data() + "\n", "scan");
  ASSERT_TRUE(file.cloud.has_colours());
  EXPECT_EQ(file.cloud.colours[0], (Colour{255, 0, 255}));
}

TEST(Pcd, CommasMaySeparateNumbers) {
  const auto file = file_of(
      "VERSION 0.7\nFIELDS X Y Z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
      "289814.25,4320978.5,170\n1, 2 ,3\n",
      "a.pcd");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{289814.25, 4320978.5, 170}, {1, 2, 3}}));
}

TEST(Pcd, LinesOfOtherProgramsInTheHeaderAreIgnored) {
  const auto file =
      file_of(replaced(ascii_pcd(), "POINTS", "SENSOR_POSE 1 2 3\nTIMESTAMP 9\nPOINTS"), "a.pcd");
  EXPECT_EQ(file.cloud.points, file_of(ascii_pcd(), "a.pcd").cloud.points);
}

// The cloud is the depth image of a camera at the origin, row by row. It shows a plane whose depths have
// errors of up to 0.03 times the width of a pixel.
TEST(Pcd, OrganisedCloudsAreSmoothedAndHaveNormals) {
  constexpr int columns = 24, rows = 18;
  std::string points;
  for (int i = 0; i < columns * rows; ++i) {
    const double depth = 2 + .002 * (i * 37 % 11 - 5) / 5, x = (i % columns - 11.5) / 30,
                 y = (i / columns - 8.5) / 30;
    points += i == 5 ? "nan nan nan\n" : cat(x * depth, ' ', y * depth, ' ', depth, '\n');
  }
  const auto text_of = [&](const std::string& size) {
    return "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n" + size +
           "\nPOINTS 432\nDATA ascii\n" + points;
  };
  const auto organised = file_of(text_of("WIDTH 24\nHEIGHT 18"), "a.pcd");
  ASSERT_EQ(organised.cloud.size(), 431U);
  EXPECT_EQ(organised.dropped_points, 1U);
  EXPECT_TRUE(organised.remarks[0].starts_with("an organised cloud of 24 x 18 points, smoothed within "))
      << organised.remarks[0];
  ASSERT_TRUE(organised.cloud.has_normals());
  for (const Vec3f& n : organised.cloud.normals) EXPECT_LT(n.z(), -.99F);
  const auto scattered = file_of(text_of("WIDTH 432\nHEIGHT 1"), "a.pcd");
  EXPECT_FALSE(scattered.cloud.has_normals());
  EXPECT_TRUE(scattered.remarks.empty());
}

TEST(Pcd, PointsOfMoreThanAMegabyteAreRefused) {
  const std::string text =
      "VERSION 0.7\nFIELDS x y z a b\nSIZE 4 4 4 8 8\nTYPE F F F F F\nCOUNT 1 1 1 65536 65536\nWIDTH "
      "1\nHEIGHT 1\n"
      "POINTS 1\nDATA binary\n";
  EXPECT_TRUE(
      message_of(text, "a.pcd").ends_with(": expected at most 1048576 bytes per point, found 1048588"));
  const std::string widest = replaced(text, "65536\n", "65534\n") + std::string(1 << 20, '\0');
  EXPECT_EQ(message_of(widest, "a.pcd"), "no error");
}

TEST(Pcd, CopiesOfLzfMayOverlapThemselves) {
  const std::string head =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 10\nPOINTS 10\nDATA binary_compressed\n";
  // The data are four literal bytes, followed by a copy of 116 bytes that starts four bytes back. The format
  // stores this length minus 2, as 7 + 107.
  const std::string packed = std::string("\x03", 1) + raw(2.F) + std::string("\xE0\x6B\x03", 3);
  const auto file = file_of(
      head + raw(static_cast<std::uint32_t>(packed.size())) + raw(std::uint32_t{120}) + packed, "scan");
  EXPECT_EQ(file.cloud.points, std::vector<Vec3>(10, Vec3(2, 2, 2)));
}

TEST(Pcd, BrokenFieldsAreNamed) {
  const std::string ascii = ascii_pcd(), binary = binary_pcd(), packed = compressed_pcd();
  const std::size_t data = pcd_header("binary").size(), packed_data = pcd_header("binary_compressed").size();
  const std::string at = ", byte " + std::to_string(data) + ": ";
  const std::string fields = "expected fields x, y and z of a numeric type, found ",
                    rest = ", z F4, rgb U4, normal_x F4, normal_y F4, normal_z F4, ...";
  const std::string at_packed = ", byte " + std::to_string(packed_data) + ": ";
  expect_messages(
      "a.pcd",
      {{replaced(ascii, "FIELDS x", "FIELDS u"), ", line 11: " + fields + "u F4, y F8" + rest},
       {replaced(ascii, "FIELDS x y z rgb normal_x normal_y normal_z tag", "FIELDS"),
        ", line 3: expected the names of the fields, found none"},
       {replaced(ascii, "SIZE 4 8", "SIZE 4 3"),
        ", line 4: expected a size of 1, 2, 4 or 8 or a count for field y, found '3'"},
       {replaced(ascii, "TYPE F F", "TYPE F D"), ", line 5: expected type F, I or U for field y, found 'D'"},
       {replaced(ascii, "TYPE F F", "TYPE F I"), ", line 11: " + fields + "x F4, y I8" + rest},
       {replaced(ascii, "COUNT 1 1", "COUNT 1 0"),
        ", line 6: expected a size of 1, 2, 4 or 8 or a count for field y, found '0'"},
       {replaced(ascii, "WIDTH 3", "WIDTH three"), ", line 7: expected a number of points, found 'three'"},
       {replaced(ascii, "POINTS 3", "POINTS -3"), ", line 10: expected a number of points, found '-3'"},
       {replaced(ascii, "POINTS 3", "POINTS 4"),
        ", line 15: expected 4 points, found the end of the file after 3"},
       {replaced(replaced(ascii, "POINTS 3\n", ""), "WIDTH 3\n", ""),
        ", line 9: expected the number of points before DATA, up to 4294967294, found none"},
       {replaced(ascii, "DATA ascii", "DATA text"),
        ", line 11: expected ascii, binary or binary_compressed, found 'text'"},
       {replaced(ascii, "HEIGHT", "height:"),
        ", line 8: expected FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, POINTS or DATA, found 'height:'"},
       {replaced(ascii, "DATA ascii\n", "").substr(0, 300),
        ", line 11: expected FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, POINTS or DATA, found '0'"},
       {replaced(ascii, "1 1.5 -1", "1 one -1"), ", line 13: expected 9 numbers, found 'one'"},
       {ascii.substr(0, ascii.rfind(" 7 8")), ", line 14: expected 9 numbers, found nothing"},
       {binary.substr(0, binary.size() - 1), at + "expected 3 points of 36 bytes, found room for 2"},
       {packed.substr(0, packed_data + 5),
        at_packed + "expected the sizes of the compressed points, found the end of the file"},
       {packed.substr(0, packed.size() - 1), at_packed + "expected 112 compressed bytes, found 111"},
       {patched(packed, packed_data + 4, std::uint32_t{100}),
        ", byte " + std::to_string(packed_data + 4) + ": expected 108 bytes of points, found 100"},
       {patched(packed, packed_data + 8, std::uint8_t{33}),
        ", byte " + std::to_string(packed_data + 8) +
            ": expected LZF-compressed points of 108 bytes, found bytes that do not unpack to as many"}});
}

TEST(Las, ReadsOldAndNewRecords) {
  for (const int minor : {0, 1, 2, 3, 4, 5}) {
    const auto file = file_of(patched(las(std::min(minor, 4)), 25, static_cast<std::uint8_t>(minor)), "scan");
    EXPECT_EQ(file.format, "LAS 1." + std::to_string(minor));
    EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1e6, 2e6, 100}, {1e6 + .5, 2e6 + .25, 99}}));
    EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{255, 0, 0}, {0, 0, 255}}));
  }
}

TEST(Las, ColoursOfEightBitsStay) {
  std::string file = las();
  file = patched(file, 227 + 20, std::uint16_t{200});
  file = patched(file, 227 + 26 + 24, std::uint16_t{255});
  EXPECT_EQ(read(file, "scan")->cloud.colours, (std::vector<Colour>{{200, 0, 0}, {0, 0, 255}}));
}

// Up to point format 5, one byte contains five bits for the class and one bit that marks withheld points.
// Later formats use two bytes.
TEST(Las, NoiseAndWithheldPointsAreLeftOut) {
  const std::size_t old_record = 227 + 15, new_record = 375 + 15;
  const std::vector<std::string> files = {
      patched(las(), old_record, std::uint8_t{7}), patched(las(), old_record, std::uint8_t{0x60 + 18}),
      patched(las(), old_record, std::uint8_t{0x80}), patched(las(4), new_record, std::uint8_t{4}),
      patched(las(4), new_record + 1, std::uint8_t{18})};
  for (const std::string& text : files) {
    const auto file = file_of(text, "a.las");
    EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1e6 + .5, 2e6 + .25, 99}}));
    EXPECT_EQ(file.left_out_points, 1U);
    EXPECT_EQ(file.dropped_points, 0U);
    EXPECT_EQ(file.remarks[0],
              "left out 1 point that the file marks as noise (classes 7 and 18) or withheld; --doubtful keep "
              "keeps them");
    const auto whole = value_of(read_cloud(bytes_of(text), "a.las", ReadOptions{{}, true}));
    EXPECT_EQ(whole.cloud.points, file_of(las(), "a.las").cloud.points);
    EXPECT_TRUE(whole.remarks.empty());
  }
  // Flags of other kinds change nothing. Classes of 32 and more change nothing either, even if their low
  // bits look like those of noise.
  for (const std::string& text :
       {patched(las(), old_record, std::uint8_t{0x62}), patched(las(4), new_record, std::uint8_t{0xCB}),
        patched(las(4), new_record + 1, std::uint8_t{39})}) {
    EXPECT_EQ(file_of(text, "a.las").cloud.size(), 2U);
    EXPECT_TRUE(file_of(text, "a.las").remarks.empty());
  }
  const std::string none =
      patched(patched(las(), old_record, std::uint8_t{7}), old_record + 26, std::uint8_t{7});
  EXPECT_EQ(message_of(none, "a.las"),
            "a.las: expected points that count, found none: left out 2 points that the file marks as noise "
            "(classes 7 and 18) or withheld; --doubtful keep keeps them");
}

TEST(Las, IsReadUpToItsEnd) {
  const std::string good = las();
  EXPECT_EQ(read(good, "a.las")->missing_points, 0U);
  for (const std::string& file : {patched(good, 107, std::uint32_t{3}), good.substr(0, good.size() - 1)}) {
    const auto got = file_of(file, "a.las");
    EXPECT_EQ(got.missing_points, 1U);
    EXPECT_EQ(got.cloud.size(), (file.size() - 227) / 26);
    EXPECT_EQ(got.cloud.points[0], Vec3(1e6, 2e6, 100));
  }
}

TEST(Las, BrokenFieldsAreNamed) {
  const std::string good = las(), newer = las(4);
  expect_messages(
      "a.las",
      {{"LASG" + good.substr(4), ", byte 0: expected LASF, found 'LASG'"},
       {good.substr(0, 100),
        ", byte 100: expected a header of at least 227 bytes, found the end of the file"},
       {newer.substr(0, 300), ", byte 300: expected a header of 375 bytes, found the end of the file"},
       {patched(good, 24, std::uint8_t{2}), ", byte 24: expected LAS 1.0 to 1.5, found 2.2"},
       {patched(good, 25, std::uint8_t{6}), ", byte 24: expected LAS 1.0 to 1.5, found 1.6"},
       {patched(good, 94, std::uint16_t{200}),
        ", byte 94: expected a header size of at least 227, found 200"},
       {patched(good, 96, std::uint32_t{5}),
        ", byte 96: expected points after the header, found them at byte 5"},
       {patched(good, 96, ~std::uint32_t{0}),
        ", byte 4294967295: expected 2 points of 26 bytes, found room for 0"},
       {patched(good, 104, std::uint8_t{130}),
        ", byte 227: expected a record of LASzip, as the points are compressed, found none"},
       {patched(good, 104, std::uint8_t{11}), ", byte 104: expected a point format from 0 to 10, found 11"},
       {patched(good, 105, std::uint16_t{10}), ", byte 105: expected records of at least 26 bytes, found 10"},
       {patched(newer, 247, ~std::uint64_t{0}),
        ", byte 247: expected fewer than 4294967295 points, found 18446744073709551615"},
       {patched(good, 131, 0.0), ", byte 131: expected a scale that is finite and not 0, found 0"},
       {patched(good, 139, std::numeric_limits<double>::infinity()),
        ", byte 139: expected a scale that is finite and not 0, found inf"},
       {newer.substr(0, 375), ", byte 375: expected 2 points of 36 bytes, found room for 0"},
       {patched(good, 163, std::numeric_limits<double>::quiet_NaN()),
        ", byte 163: expected a finite offset, found nan"},
       {good.substr(0, 227 + 25), ", byte 227: expected 2 points of 26 bytes, found room for 0"},
       {patched(good, 107, std::uint32_t{0}), ": expected points, found none"}});
}

}  // namespace
}  // namespace relievo
