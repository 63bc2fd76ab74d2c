#include "paper/control_points.h"

#include <gtest/gtest.h>

#include "support/planar_points.h"

namespace relievo::paper {
namespace {

struct Chosen {
  std::vector<Vec2> points = random_points(1000);
  std::vector<std::uint8_t> is_boundary = std::vector<std::uint8_t>(1000, 0);
  double rho = std::sqrt(1.0 / 1000);
};

// No chosen point may be in the region of another one, and every point must be in a region.
TEST(PaperControlPoints, AreGrownByTheRadiusOfSection42) {
  Chosen c;
  for (std::size_t i = 500; i < 600; ++i) c.is_boundary[i] = 1;
  const std::vector<Index> chosen = control_points(c.points, c.is_boundary, c.rho, 100);
  const double radius = std::sqrt(1000.0 / 100) * c.rho;
  for (Index i = 0; i < 1000; ++i) {
    double nearest = 1e9;
    for (const Index j : chosen)
      if (i != j) nearest = std::min(nearest, (c.points[i] - c.points[j]).norm());
    const bool is_chosen = std::ranges::find(chosen, i) != chosen.end();
    EXPECT_EQ(nearest >= radius, is_chosen) << i;
  }
  EXPECT_EQ(chosen[0], 500U);  // boundary points come first
  EXPECT_GT(chosen.size(), 40U);
  EXPECT_LT(chosen.size(), 110U);
}

TEST(PaperControlPoints, AreAllPointsIfThatManyAreAskedFor) {
  const Chosen c;
  EXPECT_EQ(control_points(c.points, c.is_boundary, c.rho, 1000).size(), 1000U);
  EXPECT_TRUE(control_points({}, {}, c.rho, 10).empty());
}

}  // namespace
}  // namespace relievo::paper
