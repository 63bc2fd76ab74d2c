#include "core/groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace relievo {
namespace {

TEST(Groups, KeepTheOrderOfTheirItems) {
  const std::vector<std::pair<std::size_t, std::string>> all{
      {2, "a"}, {0, "b"}, {2, "c"}, {2, "d"}, {0, "e"}};
  const auto groups = grouped<std::string>(4, [&](auto&& add) {
    for (const auto& [group, item] : all) add(group, item);
  });
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_TRUE(std::ranges::equal(groups[0], std::vector<std::string>{"b", "e"}));
  EXPECT_TRUE(groups[1].empty());
  EXPECT_TRUE(std::ranges::equal(groups[2], std::vector<std::string>{"a", "c", "d"}));
  EXPECT_TRUE(groups[3].empty());
}

TEST(Groups, OfNothingAreEmpty) {
  EXPECT_EQ((grouped<int>(0, [](auto&&) {}).size()), 0U);
  EXPECT_TRUE((grouped<int>(2, [](auto&&) {})[1].empty()));
}

}  // namespace
}  // namespace relievo
