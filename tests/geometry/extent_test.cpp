#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "geometry/hilbert.h"
#include "geometry/weld.h"
#include "support/shapes.h"

namespace relievo {
namespace {

TEST(Extent, LongerSideIsInTheViewPlane) {
  EXPECT_EQ(Box::of(std::vector<Vec3>{{1, 2, 0}, {4, 9, 50}, {2, 3, 0}}).longer_side(), 7);
  EXPECT_EQ(Box().longer_side(), 0);
}

TEST(Weld, FindsTheFirstOfCoincidentPoints) {
  const std::vector<Vec3> points{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {1, 2, 4}, {0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(first_coincident(points), (std::vector<Index>{0, 1, 0, 3, 1, 0}));
  EXPECT_TRUE(first_coincident({}).empty());
}

// Returns random points of a coarse lattice. Many of them coincide, and coordinates that are zero may be 0 or -0.
std::vector<Vec3> lattice_points(std::size_t n) {
  std::mt19937 random(5);
  std::vector<Vec3> points(n);
  for (Vec3& p : points)
    for (double& value : p) value = (random() % 2 ? 1 : -1) * .25 * static_cast<double>(random() % 11);
  return points;
}

TEST(Weld, FindsTheSameAsTheComparisonOfAllPairs) {
  const std::vector<Vec3> points = lattice_points(3000);
  const std::vector<Index> first = first_coincident(points);
  for (Index i = 0; i < points.size(); ++i)
    ASSERT_EQ(first[i], std::ranges::find(points, points[i]) - points.begin()) << i;
}

TEST(Weld, TreatsZeroAndMinusZeroAlike) {
  EXPECT_EQ(first_coincident(std::vector<Vec3>{{0, 1, -0.0}, {-0.0, 1, 0}}), (std::vector<Index>{0, 0}));
}

TEST(Weld, EndsWithManyEqualPointsThatAreNotNumbers) {
  const std::vector<Vec3> points(100000, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(first_coincident(points), std::vector<Index>(points.size(), 0));
}

TEST(Weld, TableGrowsBeyondWhatWasExpected) {
  const std::vector<Vec3> points = lattice_points(3000);
  const std::vector<Index> first = first_coincident(points);
  PointTable table(0);
  for (Index i = 0; i < points.size(); ++i)
    ASSERT_EQ(table.find_or_add(points[i], PointTable::hash_of(points[i]), points.data(), i), first[i]) << i;
}

std::vector<Vec3> ordered(const std::vector<Vec3>& points) {
  std::vector<Vec3> result;
  for (const Index i : space_curve_order(points)) result.push_back(points[i]);
  return result;
}

TEST(SpaceCurve, DoesNotDependOnTheOrderGiven) {
  std::vector<Vec3> points = test::sphere(500, 3).points;
  const std::vector<Vec3> once = ordered(points);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(ordered(points), once);
  EXPECT_NE(points, once);
}

// Consecutive points on the curve must be less than 0.2 apart on average. In random order the average would
// be 4/3, the mean distance of two points on a unit sphere.
TEST(SpaceCurve, KeepsNeighboursTogether) {
  const std::vector<Vec3> points = ordered(test::sphere(4000, 1).points);
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  EXPECT_LT(sum / 4000, .2);
}

}  // namespace
}  // namespace relievo
