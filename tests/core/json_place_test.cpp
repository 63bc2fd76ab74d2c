#include "relievo/core/json_place.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(JsonPlace, IsThatOfTheFirstMistake) {
  EXPECT_EQ(json_error_place(R"({"a": [1, 2.5e3, true, null, "x"]})"), "");
  EXPECT_EQ(json_error_place("{\"a\": 1,}"), "line 1, column 9");
  EXPECT_EQ(json_error_place("{\n  \"a\": 1,\n  \"b\" 2\n}"), "line 3, column 7");
  EXPECT_EQ(json_error_place("[1, 2"), "line 1, column 6");
  EXPECT_EQ(json_error_place(""), "line 1, column 1");
  EXPECT_EQ(json_error_place("not json"), "line 1, column 2");
}

}  // namespace
}  // namespace relievo
