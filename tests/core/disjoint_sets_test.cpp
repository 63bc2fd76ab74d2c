#include "core/disjoint_sets.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(DisjointSets, BeginAsSingleNumbers) {
  DisjointSets sets(3);
  for (Index i = 0; i < 3; ++i) {
    EXPECT_EQ(sets.find(i), i);
    EXPECT_EQ(sets.size_of(i), 1U);
  }
}

TEST(DisjointSets, AreJoinedThroughAnyOfTheirNumbers) {
  DisjointSets sets(6);
  sets.join(0, 1);
  sets.join(2, 3);
  sets.join(4, 5);
  sets.join(3, 0);
  sets.join(1, 2);  // 1 and 2 are already in the same set
  for (const Index i : {1U, 2U, 3U}) EXPECT_EQ(sets.find(i), sets.find(0));
  EXPECT_NE(sets.find(4), sets.find(0));
  EXPECT_EQ(sets.size_of(2), 4U);
  EXPECT_EQ(sets.size_of(5), 2U);
}

}  // namespace
}  // namespace relievo
