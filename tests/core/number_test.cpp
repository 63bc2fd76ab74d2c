#include "core/number.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>

namespace relievo {
namespace {

struct WrittenNumber {
  std::string text;
  double value;
};

// Returns a random finite double, and its text with `digits` significant digits. With 17 digits the
// text determines the double exactly.
WrittenNumber random_number(std::mt19937_64& random, int digits) {
  double value = 0;
  do value = std::bit_cast<double>(random());
  while (!std::isfinite(value));
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return {text.data(), value};
}

TEST(Number, ReadsBackWhatIsWrittenWithAllDigits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const auto [text, value] = random_number(random, 17);
    const ParsedNumber parsed = detail::parse_double_by_hand(text);
    if (std::fpclassify(value) != FP_NORMAL) continue;
    ASSERT_EQ(parsed.value, value) << text;
    ASSERT_EQ(parsed.end, text.data() + text.size()) << text;
    ASSERT_EQ(parsed.error, std::errc()) << text;
  }
}

TEST(Number, StopsWhereANumberEnds) {
  const auto length = [](const std::string& text) {
    const ParsedNumber parsed = detail::parse_double_by_hand(text);
    return parsed.error == std::errc() ? static_cast<int>(parsed.end - text.data()) : -1;
  };
  EXPECT_EQ(length("1.5,2"), 3);
  EXPECT_EQ(length("1e5x"), 3);
  EXPECT_EQ(length("1e+x"), 1);
  EXPECT_EQ(length("1."), 2);
  EXPECT_EQ(length(".5"), 2);
  EXPECT_EQ(length("0x10"), 1);
  EXPECT_EQ(length("1.2.3"), 3);
  EXPECT_EQ(length("-inf"), 4);
  EXPECT_EQ(length("nan "), 3);
  for (const char* wrong : {"", "-", "+1", " 1", "e5", ".", "-.", "x", "- 1", "--1"})
    EXPECT_EQ(length(wrong), -1) << wrong;
}

TEST(Number, SaysThatANumberIsOutOfRange) {
  for (const char* beyond : {"1e999", "-1e999", "1e-999", "0.00000000000000000001e-320"})
    EXPECT_EQ(detail::parse_double_by_hand(beyond).error, std::errc::result_out_of_range) << beyond;
  EXPECT_EQ(detail::parse_double_by_hand("0e-999").value, 0);
  EXPECT_TRUE(std::signbit(detail::parse_double_by_hand("-0").value));
}

#if defined(__cpp_lib_to_chars)
// The expected values are those of the standard library. Texts with few digits take the parser's fast path;
// texts with many digits do not.
TEST(Number, DoesWhatTheStandardLibraryDoes) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 50'000; ++i) {
    std::string text = random_number(random, 1 + i % 25).text;
    if (i % 3 == 0) text.insert(random() % (text.size() + 1), 1, "0.e-+19x"[random() % 8]);
    const ParsedNumber parsed = detail::parse_double_by_hand(text);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    ASSERT_EQ(parsed.error, error) << text;
    ASSERT_EQ(parsed.end, end) << text;
    if (error == std::errc()) ASSERT_EQ(parsed.value, value) << text;
  }
}
#endif

}  // namespace
}  // namespace relievo
