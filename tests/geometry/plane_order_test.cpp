#include "geometry/hilbert.h"

#include <gtest/gtest.h>

#include <limits>

namespace relievo {
namespace {

TEST(PlaneOrder, ScalesIntoTheUnitSquare) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto points = in_unit_square(std::vector<Vec2>{{-2, 1}, {2, 3}, {0, infinity}, {1, 1}});
  EXPECT_EQ(points[0], Eigen::Vector2f(0, 0));
  EXPECT_EQ(points[1], Eigen::Vector2f(1, .5F));
  EXPECT_EQ(points[2], Eigen::Vector2f(0, 0));
  EXPECT_EQ(points[3], Eigen::Vector2f(.75F, 0));
  EXPECT_EQ(in_unit_square(std::vector<Vec2>(2, Vec2(7, 7)))[1], Eigen::Vector2f(0, 0));
  EXPECT_TRUE(in_unit_square({}).empty());
}

// The order visits the four quarters of the square one after the other. Within each quarter it visits the
// four quarters of that quarter in the same way.
TEST(PlaneOrder, PassesQuartersOneByOne) {
  std::vector<Eigen::Vector2f> points;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      points.emplace_back((static_cast<float>(x) + .5F) / 8, (static_cast<float>(y) + .5F) / 8);
  const std::vector<Index> order = plane_order(points);
  for (Index i = 0; i < 64; ++i) {
    Index x = 0, y = 0;
    for (Index bit = 0; bit < 3; ++bit) {
      x |= (i >> 2 * bit & 1) << bit;
      y |= (i >> (2 * bit + 1) & 1) << bit;
    }
    EXPECT_EQ(order[i], 8 * y + x);
  }
}

TEST(PlaneOrder, KeepsTwinsInTheirOrder) {
  EXPECT_EQ(plane_order(std::vector<Eigen::Vector2f>(3, Eigen::Vector2f(0, 0))),
            (std::vector<Index>{0, 1, 2}));
}

}  // namespace
}  // namespace relievo
