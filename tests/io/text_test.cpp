#include "io/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relievo::io {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> all;
  Lines lines(text);
  while (const auto line = lines.next()) all.emplace_back(*line);
  EXPECT_EQ(lines.number(), all.size());
  EXPECT_EQ(lines.offset(), text.size());
  return all;
}

using Strings = std::vector<std::string>;

TEST(Lines, EndWithLfCrlfOrCr) {
  EXPECT_EQ(lines_of("a\nb\n\nc"), (Strings{"a", "b", "", "c"}));
  EXPECT_EQ(lines_of("a\r\nb\r\n\r\nc\r\n"), (Strings{"a", "b", "", "c"}));
  EXPECT_EQ(lines_of("a\rb\r\rc\r"), (Strings{"a", "b", "", "c"}));
  EXPECT_EQ(lines_of("a\rb\nc\r\nd"), (Strings{"a", "b", "c", "d"}));
}

TEST(Lines, OfAnEmptyTextAreNone) {
  EXPECT_TRUE(lines_of("").empty());
}

TEST(Lines, OfALongTextWithoutLfTakeLinearTime) {
  const std::string text(2000000, '\r');  // if the running time were quadratic, this would take hours
  EXPECT_EQ(lines_of(text).size(), text.size());
}

TEST(Words, AreSeparatedByAnyBlanks) {
  Words words(" one\t two \v\f three  ");
  for (const char* expected : {"one", "two", "three", "", ""}) EXPECT_EQ(words.next(), expected);
}

TEST(ParseNumber, ReadsEveryNotation) {
  const std::vector<std::pair<std::string, double>> all = {{"0", 0},
                                                           {"-12.5", -12.5},
                                                           {"+12.5", 12.5},
                                                           {".5", .5},
                                                           {"5.", 5},
                                                           {"1e3", 1000},
                                                           {"1E+03", 1000},
                                                           {"4500123.123456789", 4500123.123456789},
                                                           // exponents as in Fortran
                                                           {"1.0D+02", 100},
                                                           {"-2.5d-1", -.25},
                                                           {"+5D3", 5000},
                                                           {"1D999", INFINITY},
                                                           {"1D-999", 0},
                                                           // numbers that are too small or too large for
                                                           // double
                                                           {"1e-999", 0},
                                                           {"0." + std::string(400, '0') + "1", 0},
                                                           {"1" + std::string(400, '0') + ".0", INFINITY}};
  for (const auto& [text, value] : all) EXPECT_EQ(parse_number(text), value) << text;
}

TEST(ParseNumber, ReadsWhatIsNotFinite) {
  for (const auto* word :
       {"nan", "NaN", "-nan", "nan(ind)", "-nan(ind)", "1.#QNAN", "-1.#IND", "1.#INF", "+nan"}) {
    const auto value = parse_number(word);
    ASSERT_TRUE(value) << word;
    EXPECT_TRUE(std::isnan(*value)) << word;
  }
  for (const auto* word : {"inf", "Inf", "INF", "infinity", "+inf", "1e999", "1e+999"})
    EXPECT_EQ(parse_number(word), INFINITY) << word;
  EXPECT_EQ(parse_number("-inf"), -INFINITY);
}

TEST(ParseNumber, RefusesAnythingElse) {
  for (const auto* word : {"",      "+",  "-", "+-1", "++1", "--1",   "1,5",   "1.5x",  "abc", "0x10", "1 2",
                           "1.2.3", "e5", ".", "1D",  "D5",  "1D5D2", "1D5e2", "1e5D2", "1D+", "nanD2"})
    EXPECT_FALSE(parse_number(word)) << word;
}

TEST(ParseInteger, RefusesFractionsAndOverflow) {
  EXPECT_EQ(parse_integer("-12"), -12);
  EXPECT_EQ(parse_integer("+12"), 12);
  EXPECT_EQ(parse_integer("9223372036854775807"), INT64_MAX);
  for (const auto* word : {"", "1.0", "9223372036854775808", "1e3", "x", "1x"})
    EXPECT_FALSE(parse_integer(word)) << word;
}

TEST(InQuotes, IsShortAndPrintable) {
  EXPECT_EQ(in_quotes("abc"), "'abc'");
  EXPECT_EQ(in_quotes(std::string_view("a\0\n\xFF", 4)), "'a" + std::string(3, '?') + "'");
  EXPECT_EQ(printable(std::string(100, 'a')), std::string(32, 'a') + "...");
}

}  // namespace
}  // namespace relievo::io
