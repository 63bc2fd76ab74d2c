// Tests E57 files that the test program itself writes. corpus_test.cpp reads files of other programs.
#include "io/e57/pages.h"
#include "support/e57_encoder.h"
#include "support/read_text.h"

namespace relievo {
namespace {

E57TestScan scan_of(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z,
                    const std::string& xml = "") {
  return {{e57_doubles("cartesianX", x), e57_doubles("cartesianY", y), e57_doubles("cartesianZ", z)}, xml};
}

// Returns the error message for a file whose contents have `by` in place of `what`.
std::string message_with(const std::string& what, const std::string& by) {
  const std::string contents = e57_contents({scan_of({1}, {2}, {3})});
  return message_of(e57_pages(replaced(contents, what, by)), "a.e57");
}

TEST(E57, ChecksumsAreThoseOfCastagnoli) {
  EXPECT_EQ(io::crc32c("123456789"), 0xE3069283U);  // the check value in catalogues of CRCs
  std::string text;
  for (int size = 0; size < 40; ++size, text += static_cast<char>(size * 37))
    EXPECT_EQ(io::crc32c(text), bitwise_crc32c(text));
}

TEST(E57, PointsColoursAndInvalidOnesAreRead) {
  const auto file = file_of(e57_sample(), "a");
  EXPECT_EQ(file.format, "E57, 1 scan");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {7, 8, 9}}));
  EXPECT_EQ(file.cloud.colours, (std::vector<Colour>{{255, 0, 9}, {7, 2, 7}}));
  EXPECT_EQ(file.dropped_points, 1U);
}

// Each packet has only seven bytes, so it ends inside a number, at any bit.
TEST(E57, IntegersOfAllWidthsAreUnpacked) {
  for (unsigned bits = 1; bits <= 64; ++bits) {
    const std::uint64_t most = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    const auto minimum = bits == 64 ? std::numeric_limits<std::int64_t>::min() : std::int64_t{-5};
    std::vector<std::int64_t> values;
    for (std::uint64_t i = 0; i < 50; ++i)
      values.push_back(
          static_cast<std::int64_t>(static_cast<std::uint64_t>(minimum) + (i * 0x9E3779B97F4A7C15U & most)));
    const auto maximum = static_cast<std::int64_t>(static_cast<std::uint64_t>(minimum) + most);
    E57TestScan scan =
        scan_of(std::vector<double>(50, 0), std::vector<double>(50, 1), std::vector<double>(50, 2));
    scan.columns[1] = e57_integers("cartesianY", minimum, maximum, values);
    const auto file = value_of(read(e57({scan}), "a"));
    for (std::size_t i = 0; i < 50; ++i)
      ASSERT_EQ(file.cloud.points[i].y(), static_cast<double>(values[i])) << bits;
  }
}

TEST(E57, ScaledIntegersAndSinglesAreRead) {
  E57TestScan scan = scan_of({0}, {0}, {0});
  scan.columns[0] = {
      "cartesianX", R"(type="ScaledInteger" minimum="-8" maximum="7" scale="0.5" offset="100")", 4, {15}};
  scan.columns[1] = {
      "cartesianY", R"(type="Float" precision="single")", 32, {std::bit_cast<std::uint32_t>(1.25F)}};
  // All z coordinates are equal, so a number of 0 bits is enough for each.
  scan.columns[2] = {"cartesianZ", R"(type="Integer" minimum="6" maximum="6")", 0, {0}};
  EXPECT_EQ(file_of(e57({scan}), "a").cloud.points[0], Vec3(103.5, 1.25, 6));
}

TEST(E57, SphericalCoordinatesAreTurnedIntoCartesianOnes) {
  const double quarter = std::acos(-1) / 2;
  const E57TestScan scan{{e57_doubles("sphericalRange", {2, 3, 5}),
                          e57_doubles("sphericalAzimuth", {0, quarter, 1}),
                          e57_doubles("sphericalElevation", {0, 0, quarter})}};
  const auto file = file_of(e57({scan}), "a");
  const std::vector<Vec3> expected = {{2, 0, 0}, {0, 3, 0}, {0, 0, 5}};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((file.cloud.points[i] - expected[i]).norm(), 1e-15);
}

// The pose consists of a rotation, a quarter turn about z as a quaternion of length 2, and a translation.
TEST(E57, ScansAreMovedByTheirPoses) {
  const std::string pose =
      "<pose><rotation><w>1.4142135623730951</w><z>1.4142135623730951</z><x/><y/></rotation>"
      "<translation><x>10</x><y>20</y><z>30</z></translation></pose>";
  E57TestScan moved = scan_of({1}, {2}, {3}, pose), still = scan_of({4}, {5}, {6});
  for (E57TestScan* scan : {&moved, &still})
    for (const char* name : {"nor:normalX", "nor:normalY", "nor:normalZ"})
      scan->columns.push_back(e57_doubles(name, {name[10] == 'X' ? 1. : 0.}));
  const auto file = file_of(e57({moved, still}), "a");
  EXPECT_EQ(file.format, "E57, 2 scans");
  EXPECT_LT((file.cloud.points[0] - Vec3(8, 21, 33)).norm(), 1e-14);
  EXPECT_EQ(file.cloud.points[1], Vec3(4, 5, 6));
  EXPECT_LT((file.cloud.normals[0] - Vec3f(0, 1, 0)).norm(), 1e-6F);
  EXPECT_EQ(file.cloud.normals[1], Vec3f(1, 0, 0));
}

// The pose has no translation. Its rotation, a quarter turn about x, is a quaternion that has only the
// components w and x.
TEST(E57, MissingPartsOfAPoseAreZero) {
  const auto file = value_of(
      read(e57({scan_of({1}, {2}, {3}, "<pose><rotation><w>2</w><x>2</x></rotation></pose>")}), "a"));
  EXPECT_LT((file.cloud.points[0] - Vec3(1, -3, 2)).norm(), 1e-14);
}

// Only red has stated limits. Integers without limits are scaled by their minimum and maximum.
// Floating-point numbers without limits are expected to be from 0 to 1.
TEST(E57, ColoursAreScaledByTheirLimits) {
  E57TestScan whole = scan_of({0, 1}, {0, 1}, {0, 1},
                              "<colorLimits><colorRedMinimum>100</colorRedMinimum>"
                              "<colorRedMaximum>300</colorRedMaximum></colorLimits>");
  E57TestScan fractions = whole;
  whole.columns.push_back(e57_integers("colorRed", 0, 1023, {100, 150}));
  whole.columns.push_back(e57_integers("colorGreen", 0, 65535, {65535, 257}));
  whole.columns.push_back(e57_doubles("colorBlue", {0.5, 2}));
  fractions.columns.push_back(e57_doubles("colorRed", {150, 300}));
  for (const char* name : {"colorGreen", "colorBlue"})
    fractions.columns.push_back(e57_doubles(name, {.2, .8}));
  EXPECT_EQ(file_of(e57({whole}), "a").cloud.colours, (std::vector<Colour>{{0, 255, 128}, {64, 1, 255}}));
  EXPECT_EQ(file_of(e57({fractions}), "a").cloud.colours,
            (std::vector<Colour>{{64, 51, 51}, {255, 204, 204}}));
  // If one scan has no colours, the whole cloud gets none.
  EXPECT_FALSE(file_of(e57({whole, scan_of({1}, {2}, {3})}), "a").cloud.has_colours());
}

TEST(E57, ScansWithoutCoordinatesAreLeftOut) {
  const E57TestScan intensities{{e57_doubles("intensity", {1, 2})}};
  const auto file = file_of(e57({scan_of({1}, {2}, {3}), intensities}), "a.e57");
  EXPECT_EQ(file.format, "E57, 1 scan");
  EXPECT_EQ(file.cloud.points, (std::vector<Vec3>{{1, 2, 3}}));
  EXPECT_EQ(file.remarks,
            (std::vector<std::string>{"left out 1 scan without coordinates, such as intensities alone"}));
  EXPECT_TRUE(message_of(e57({intensities}), "a.e57").ends_with("found intensity"));
}

TEST(E57, ColoursOfSomeScansAreLeftOut) {
  E57TestScan coloured = scan_of({1}, {2}, {3});
  for (const char* const name : {"colorRed", "colorGreen", "colorBlue"})
    coloured.columns.push_back(e57_integers(name, 0, 255, {7}));
  const auto file = file_of(e57({coloured, scan_of({4}, {5}, {6})}), "a.e57");
  EXPECT_FALSE(file.cloud.has_colours());
  EXPECT_EQ(file.remarks, (std::vector<std::string>{"left out the colours, which only 1 of 2 scans have"}));
}

TEST(E57, DamagedPagesAreNamed) {
  const std::vector<double> many(100, 1);
  const std::string whole = e57({scan_of(many, many, many)});
  ASSERT_GT(whole.size(), 2048U);
  std::string file = whole;
  file[1500] ^= 1;
  EXPECT_EQ(message_of(file, "a.e57"),
            cat("a.e57, byte 1024: expected page 2 of ", file.size() / 1024,
                " as its checksum says, found bytes of another checksum; the file is damaged, get it anew"));
  EXPECT_EQ(message_of(whole.substr(0, 1024), "a.e57"),
            cat("a.e57, byte 16: expected a file of ", file.size(), " bytes, in pages of 1024, found 1024"));
}

TEST(E57, BrokenDescriptionsAreNamed) {
  EXPECT_EQ(message_with("</data3D>", "</data>"),
            "a.e57, line 9 of the XML: expected the end of 'data3D', found that of 'data'");
  EXPECT_EQ(message_with("cartesianZ", "altitude"),
            "a.e57, element prototype: expected cartesianX, Y and Z or sphericalRange, Azimuth and "
            "Elevation, found cartesianX, cartesianY, altitude");
  EXPECT_EQ(message_with("type=\"Float\"", "type=\"Text\""),
            "a.e57, element cartesianX: expected a type Integer, ScaledInteger or Float, found 'Text'");
  EXPECT_EQ(message_with("recordCount=\"1\"", "recordCount=\"-1\""),
            "a.e57, element points: expected a number as recordCount, found '-1'");
  EXPECT_TRUE(message_with("recordCount=\"1\"", "recordCount=\"9\"")
                  .ends_with(": expected 9 numbers of cartesianX, found 1"));
  EXPECT_EQ(message_with("recordCount=\"1\"", "recordCount=\"0\""), "a.e57: expected points, found none");
}

// Returns the part of a message that starts with "expected".
std::string after_place(const std::string& message) {
  return message.substr(message.find("expected"));
}

TEST(E57, BrokenXmlIsNamed) {
  const auto found = [](const char* what, const char* by) { return after_place(message_with(what, by)); };
  EXPECT_EQ(found("<data3D", "<!ELEMENT><data3D"), "expected an element, found a document type");
  EXPECT_EQ(found("<name><![CDATA[<a>]]></name>", "</e57Root><e57Root>"),
            "expected one root element, found '<e57Root>' after it");
  EXPECT_EQ(found("</e57Root>", "</e57Root>x"), "expected an element, found 'x'");
  EXPECT_EQ(found("<data3D", "<>"), "expected the name of an element, found none");
  EXPECT_EQ(found("</e57Root>", "<e57Root "), "expected the end of a tag, found the end");
  EXPECT_EQ(found("</e57Root>", ""), "expected the end of the element 'e57Root', found the end");
  EXPECT_EQ(found("<prototype>", "<proto>"), "expected the end of 'proto', found that of 'prototype'");
}

TEST(E57, BrokenPrototypesAreNamed) {
  const E57Column integers = e57_integers("cartesianX", 1, 9, {5}),
                  one = e57_integers("cartesianX", 5, 5, {5});
  const auto found = [](E57Column column, const std::string& attributes) {
    if (!attributes.empty()) column.attributes = attributes;
    E57Column y = column, z = column;
    y.name = "cartesianY";
    z.name = "cartesianZ";
    return after_place(message_of(e57({{{column, y, z}}}), "a.e57"));
  };
  EXPECT_EQ(found(integers, R"(type="Integer" minimum="low" maximum="9")"),
            "expected an integer as minimum, found 'low'");
  EXPECT_EQ(found(integers, R"(type="Integer" minimum="9" maximum="1")"),
            "expected a maximum that is not below the minimum, 9, found 1");
  EXPECT_EQ(found(one, ""), "expected coordinates that differ, found a single point");
}

TEST(E57, BrokenSectionsAreNamed) {
  const std::string good = e57_contents({scan_of({1}, {2}, {3})});
  const auto found = [](const std::string& contents) {
    return after_place(message_of(e57_pages(contents), "a.e57"));
  };
  const std::size_t section = 48, data_packet = 100;
  EXPECT_EQ(found(patched(good, section, '\2')),
            "expected a section of compressed vectors, number 1, found 2");
  EXPECT_TRUE(found(patched(good, section + 8, std::uint64_t{1} << 40))
                  .starts_with("expected a section within the file, with its packets in it, found "));
  EXPECT_EQ(found(patched(good, data_packet, '\7')),
            "expected an index, data or empty packet (0 to 2), found 7");
  EXPECT_TRUE(found(patched(good, data_packet + 2, std::uint16_t{0xFFFF}))
                  .starts_with("expected a packet within its section, of which "));
  EXPECT_TRUE(found(patched(good, data_packet + 6, std::uint16_t{60000}))
                  .starts_with("expected columns within a packet of "));
}

TEST(E57, EveryDamageUnderRightChecksumsGetsAnAnswer) {
  const std::string contents = e57_contents({scan_of({1, 2}, {3, 4}, {5, 6}, "<pose/>")});
  for (std::size_t at = 0; at < contents.size(); ++at)
    for (const char by : {'\0', '<', '>', '"', '9', '\x7F', '\xFF'}) {
      std::string broken = contents;
      broken[at] = by;
      ASSERT_EQ(check_answer(read(e57_pages(broken), "a.e57"), "a.e57"), "") << at;
    }
}

}  // namespace
}  // namespace relievo
