#include "relievo/core/length.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/results.h"

namespace relievo {
namespace {

TEST(Length, HasAUnitOrThatOfAllOthers) {
  EXPECT_EQ(parse_length("12.5mm"), 12.5);
  EXPECT_EQ(parse_length("12.5"), 12.5);
  EXPECT_EQ(parse_length("12.5", LengthUnit::inch), 317.5);
  EXPECT_EQ(parse_length("12.5mm", LengthUnit::inch), 12.5);
  EXPECT_EQ(parse_length("1cm"), 10);
  EXPECT_EQ(parse_length("4in"), 101.6);
  EXPECT_EQ(parse_length("4 in"), 101.6);
  EXPECT_EQ(parse_length("4\""), 101.6);
  EXPECT_EQ(parse_length("-2e-1cm"), -2);
}

TEST(Length, MayBeAFraction) {
  EXPECT_DOUBLE_EQ(*parse_length("3/8in"), 9.525);
  EXPECT_DOUBLE_EQ(*parse_length("1/4", LengthUnit::inch), 6.35);
  EXPECT_DOUBLE_EQ(*parse_length("1.5/3mm"), .5);
}

// Each case is a text and its length in millimetres, or null if the text must be refused. The tests of the
// page's parseLength() use the same file.
TEST(Length, IsWhatTheSharedCasesSay) {
  std::ifstream file(std::filesystem::path(__FILE__).parent_path() / "lengths.json");
  const auto cases = nlohmann::json::parse(file);
  ASSERT_GT(cases.size(), 50U);
  for (const auto& each : cases) {
    const std::string text = each[0];
    const auto length = parse_length(text);
    ASSERT_EQ(length.has_value(), !each[1].is_null()) << "'" << text << "'";
    if (length) {
      EXPECT_DOUBLE_EQ(*length, each[1].get<double>()) << text;
      continue;
    }
    expect_error(length, ErrorKind::option, "'" + text + "'");
  }
}

TEST(LengthUnit, IsKnownByItsName) {
  for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::inch}) EXPECT_EQ(parse_unit(name_of(unit)), unit);
  EXPECT_EQ(parse_unit("ft").error().input, "units");
}

}  // namespace
}  // namespace relievo
