#include "geometry/weld.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(Compact, KeepsTheOrderOfTheUsedPoints) {
  std::vector<Triangle> triangles{{5, 1, 3}, {3, 1, 0}};
  const UsedPoints used = compact(7, triangles);
  EXPECT_EQ(used.points, (std::vector<Index>{0, 1, 3, 5}));
  EXPECT_EQ(used.new_number, (std::vector<Index>{0, 1, no_index, 2, no_index, 3, no_index}));
  EXPECT_EQ(triangles, (std::vector<Triangle>{{3, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(used.pick(std::vector<int>{10, 11, 12, 13, 14, 15, 16}), (std::vector<int>{10, 11, 13, 15}));
  EXPECT_TRUE(used.pick(std::vector<int>{}).empty());
}

TEST(Compact, UsesNoPointWithoutTriangles) {
  EXPECT_TRUE(compact(3, {}).points.empty());
}

}  // namespace
}  // namespace relievo
