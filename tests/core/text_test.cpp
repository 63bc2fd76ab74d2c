#include "relievo/core/text.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(Text, JoinsTextsCharactersAndNumbers) {
  EXPECT_EQ(cat("found ", 3, ',', std::size_t{4000000000}, ' ', 2.5, " and ", -1),
            "found 3,4000000000 2.5 and -1");
  EXPECT_EQ(cat(), "");
}

TEST(Text, WritesFractionsWithSixDigits) {
  EXPECT_EQ(cat(1.0 / 3), "0.333333");
  EXPECT_EQ(cat(1e7), "1e+07");
}

TEST(Text, ParsesThreeNumbers) {
  EXPECT_EQ(parse_triple("1,-2.5,3e2"), Vec3(1, -2.5, 300));
  for (const char* wrong :
       {"", "1,2", "1,2,3,4", "1,2,", "a,2,3", "1, 2,3", "1,2,3 ", "inf,0,0", "nan,0,0", "1e999,0,0"})
    EXPECT_FALSE(parse_triple(wrong)) << wrong;
}

}  // namespace
}  // namespace relievo
