#include "relievo/core/length.h"

#include <gtest/gtest.h>

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

TEST(Length, OfAnyOtherTextIsNone) {
  for (const char* text : {"", "mm", "4ft", "4inch", "4 i n", "4in ", "1/0in", "1/in", "1/-2", "1//2", "nan",
                           "inf", "1e999", "4mm4", "1/2/3", " 4"}) {
    const auto length = parse_length(text);
    ASSERT_FALSE(length) << text;
    EXPECT_EQ(length.error().kind, ErrorKind::option);
    EXPECT_NE(length.error().message().find(std::string("'") + text + "'"), std::string::npos);
  }
}

TEST(LengthUnit, IsKnownByItsName) {
  for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::inch}) EXPECT_EQ(parse_unit(name_of(unit)), unit);
  EXPECT_EQ(parse_unit("ft").error().input, "units");
}

}  // namespace
}  // namespace relievo
