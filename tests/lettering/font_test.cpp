#include <array>
#include <fstream>
#include <iterator>
#include <memory>

#include "lettering/ornament_shapes.h"
#include "support/admesh.h"
#include "support/results.h"

namespace relievo {
namespace {

const std::string noto = "/usr/share/fonts/truetype/noto/";

Ornament text_in(const std::string& text, const std::string& file = {}) {
  Ornament ornament{.text = text};
  if (file.empty()) return ornament;
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  const auto* const begin = reinterpret_cast<const std::byte*>(bytes.data());
  ornament.font = std::make_shared<const FontFile>(file, std::vector<std::byte>(begin, begin + bytes.size()));
  return ornament;
}

Box box_of(const Outlines& outlines) {
  Box box;
  for (const std::vector<Vec2>& outline : outlines)
    for (const Vec2& p : outline) box.extend({p.x(), p.y(), 0});
  return box;
}

TEST(ShapeLine, CapitalsAreOneHigh) {
  const ShapedLine line = shape_line(text_in("HE"), .001).value();
  ASSERT_EQ(line.clusters.size(), 2U);
  for (const GlyphCluster& cluster : line.clusters) {
    EXPECT_NEAR(box_of(cluster.outlines).min.y(), 0, 1e-6);
    EXPECT_NEAR(box_of(cluster.outlines).max.y(), 1, 1e-6);
  }
  EXPECT_NEAR(line.clusters[1].begin, line.clusters[0].advance, 1e-12);
  EXPECT_GT(line.x_height, .6);
  EXPECT_LT(line.x_height, .85);
}

TEST(ShapeLine, AreasOfCurvesDoNotDependOnTheTolerance) {
  const auto area = [](double tolerance) {
    double twice = 0;
    for (const Segment& s : union_boundary(shape_line(text_in("O"), tolerance).value().clusters[0].outlines))
      twice += s.from.x() * s.to.y() - s.from.y() * s.to.x();
    return twice / 2;
  };
  EXPECT_NEAR(area(.01), area(1e-5), .05);
  EXPECT_NEAR(area(.0005), area(1e-5), .0025);
}

TEST(ShapeLine, HasGreekAndCyrillicInside) {
  EXPECT_TRUE(check_text(text_in("ΔΗΜΟΚΡΑΤΙΑ ελευθερία МОСКВА Ґданськ Åse œuvre 1848")));
}

TEST(ShapeLine, NamesMissingCharactersOnce) {
  const std::string message = message_of(check_text(text_in("aאbאש")));
  EXPECT_EQ(message,
            "text: expected characters of the font inside, Noto Serif, found others: 'א' (U+05D0), 'ש' "
            "(U+05E9); font names another font");
}

TEST(ShapeLine, RefusesWhatItCannotSet) {
  EXPECT_NE(
      message_of(check_text(text_in("a\nb"))).find("expected one line of text, found a control character"),
      std::string::npos);
  EXPECT_TRUE(message_of(check_text(text_in("   "))).contains("expected visible characters, found none"));
  EXPECT_TRUE(message_of(check_text(text_in(std::string(5000, 'a')))).contains("1000"));
  EXPECT_TRUE(message_of(check_text(text_in("a", "/etc/passwd"))).contains("which is none"));
}

TEST(ShapeLine, SetsNumbersWithinArabicInTheOrderOfReading) {
  const std::string font = noto + "NotoNaskhArabic-Regular.ttf";
  if (!std::filesystem::exists(font)) GTEST_SKIP() << "fonts-noto-core is not installed";
  const ShapedLine both = shape_line(text_in("دا ١٢", font), .01).value();
  const ShapedLine digits = shape_line(text_in("١٢", font), .01).value();
  const ShapedLine dal = shape_line(text_in("د", font), .01).value();
  ASSERT_EQ(both.clusters.size(), 5U);  // from left to right: digits 1 2, a space, alef, dal
  for (const std::size_t i : {0, 1}) {
    EXPECT_DOUBLE_EQ(both.clusters[i].advance, digits.clusters[i].advance);
    EXPECT_NEAR(box_of(both.clusters[i].outlines).size().x(), box_of(digits.clusters[i].outlines).size().x(),
                1e-9);
  }
  EXPECT_NEAR(box_of(both.clusters[4].outlines).size().x(), box_of(dal.clusters[0].outlines).size().x(),
              1e-9);
}

// Returns the advances of the glyphs, in units of the font, as the program hb-shape computes them. Empty if
// hb-shape is not installed.
std::vector<double> advances_of(const std::string& text, const std::string& font) {
  const std::string command =
      "hb-shape --no-glyph-names --output-format=json '" + font + "' '" + text + "' 2>/dev/null";
  const std::string out = test::output_of(command);
  std::vector<double> advances;
  for (std::size_t at = 0; (at = out.find("\"ax\":", at)) != std::string::npos;)
    advances.push_back(std::stod(out.substr(at += 5)));
  return advances;
}

class Scripts : public testing::TestWithParam<std::array<const char*, 2>> {};

TEST_P(Scripts, HaveTheAdvancesOfHbShape) {
  const auto [text, file] = GetParam();
  if (!std::filesystem::exists(noto + file)) GTEST_SKIP() << "fonts-noto-core is not installed";
  const std::vector<double> advances = advances_of(text, noto + file);
  if (advances.empty()) GTEST_SKIP() << "hb-shape of libharfbuzz-bin is not installed";
  const ShapedLine line = shape_line(text_in(text, noto + file), .01).value();
  double total = 0;
  for (const double advance : advances) total += advance;
  ASSERT_LE(line.clusters.size(), advances.size());
  // The height of capitals in units of the font is unknown here, so ratios of advances are compared.
  std::size_t glyph = 0;
  for (const GlyphCluster& cluster : line.clusters) {
    double sum = 0;
    while (glyph < advances.size() && sum / total < cluster.advance / line.advance - 1e-9)
      sum += advances[glyph++];
    EXPECT_NEAR(sum / total, cluster.advance / line.advance, 1e-9);
    while (glyph < advances.size() && advances[glyph] == 0) ++glyph;
  }
  EXPECT_EQ(glyph, advances.size());
}

INSTANTIATE_TEST_SUITE_P(Noto, Scripts,
                         testing::Values(std::array{"AVATAR fi", "NotoSerif-Regular.ttf"},
                                         std::array{"السلام عليكم", "NotoNaskhArabic-Regular.ttf"},
                                         std::array{"שָׁלוֹם", "NotoSerifHebrew-Regular.ttf"},
                                         std::array{"क्षत्रिय हिन्दी", "NotoSerifDevanagari-Regular.ttf"}),
                         [](const auto& test) {
                           const std::string_view font = test.param[1];
                           return std::string(font.substr(0, font.find('-')));
                         });

TEST(ShapeLine, JoinsArabicLetters) {
  const std::string font = noto + "NotoNaskhArabic-Regular.ttf";
  if (!std::filesystem::exists(font)) GTEST_SKIP() << "fonts-noto-core is not installed";
  const ShapedLine joined = shape_line(text_in("ببب", font), .01).value();
  const ShapedLine alone = shape_line(text_in("ب", font), .01).value();
  ASSERT_EQ(joined.clusters.size(), 3U);
  EXPECT_TRUE(joined.clusters[0].is_joined);
  EXPECT_LT(joined.advance, 2.5 * alone.advance);
  Outlines all;
  for (const GlyphCluster& cluster : joined.clusters)
    all.insert(all.end(), cluster.outlines.begin(), cluster.outlines.end());
  double apart = 0, together = 0;
  for (const GlyphCluster& cluster : joined.clusters)
    for (const Segment& s : union_boundary(cluster.outlines)) apart += (s.to - s.from).norm();
  for (const Segment& s : union_boundary(all)) together += (s.to - s.from).norm();
  EXPECT_LT(together, apart - .1);  // the strokes touch, so there is no outline between them
}

}  // namespace
}  // namespace relievo
