#include "geometry/hilbert.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace relievo {
namespace {

TEST(HilbertOrder, StepsFromCellToAdjacentCell) {
  const int side = 64;
  std::vector<Vec2> points;
  for (int i = 0; i < side * side; ++i) points.emplace_back(64 * (i % side), 64 * (i / side));
  points.emplace_back(4095, 4095);  // makes the finest cells of the curve unit squares
  std::vector<Index> order = hilbert_order(points);
  std::erase(order, side * side);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Vec2 step = points[order[k]] - points[order[k - 1]];
    EXPECT_EQ(step.lpNorm<1>(), 64) << "at " << k;
  }
}

TEST(HilbertOrder, NamesEachPointOnce) {
  for (const std::size_t n : {0, 1, 2, 9, 1000}) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n; ++i)
      points.emplace_back(static_cast<double>(i * i % 17), static_cast<double>(i % 5));
    std::vector<Index> order = hilbert_order(points), all(n);
    std::iota(all.begin(), all.end(), 0);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, all);
  }
}

TEST(HilbertOrder, KeepsEqualPointsByNumber) {
  const std::vector<Vec2> points(100, Vec2(1, 2));
  const std::vector<Index> order = hilbert_order(points);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

// A single distant point must not change the order of the others, as it would if all others fell into one cell.
TEST(HilbertOrder, ResolvesClusters) {
  std::vector<Vec2> points;
  for (int i = 0; i < 1024; ++i) points.emplace_back(i * 37 % 32, i / 32);
  const std::vector<Index> alone = hilbert_order(points);
  points.emplace_back(1e12, 0);
  std::vector<Index> together = hilbert_order(points);
  std::erase(together, 1024);
  EXPECT_EQ(together, alone);
}

}  // namespace
}  // namespace relievo
