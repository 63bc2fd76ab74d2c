#include "geometry/near_search.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace relievo {
namespace {

using Balls = std::vector<NearSearch<Vec3>::Ball>;

std::vector<std::vector<Index>> found_in(const Balls& balls, const std::vector<Vec3>& points) {
  const KdTree<Vec3> tree(points);
  NearSearch<Vec3> search(tree, points);
  std::vector<std::vector<Index>> found(balls.size());
  search.each(
      0, balls.size(), [&](std::size_t i) { return balls[i]; },
      [&](std::size_t i, std::span<const Index> near) { found[i].assign(near.begin(), near.end()); });
  return found;
}

Balls random_balls(std::size_t n, double radius) {
  test::Random random(5);
  Balls balls;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 centre(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    balls.push_back({centre.normalized(), radius * static_cast<double>(1 + i % 7)});
  }
  return balls;
}

TEST(NearSearch, FindsWhatIsNearerThanTheRadius) {
  const std::vector<Vec3> points = test::sphere(3'000, 1).points;
  const Balls balls = random_balls(100, .04);
  const auto found = found_in(balls, points);
  std::size_t most = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    std::vector<Index> near;
    for (Index j = 0; j < points.size(); ++j)
      if ((points[j] - balls[i].centre).norm() < balls[i].radius) near.push_back(j);
    EXPECT_EQ(found[i], near) << i;
    most = std::max(most, near.size());
  }
  EXPECT_GT(most, 50U);
}

TEST(NearSearch, FindsTheSameWhateverIsSearchedTogether) {
  const std::vector<Vec3> points = test::sphere(3'000, 1).points;
  Balls close;
  for (int i = 0; i < 60; ++i) close.push_back({points[10] + 1e-3 * i * Vec3::UnitX(), .2});
  const auto together = found_in(close, points);
  for (std::size_t i = 0; i < close.size(); ++i) EXPECT_EQ(found_in({close[i]}, points)[0], together[i]);
}

TEST(NearSearch, FindsNothingWithoutPointsOrRadius) {
  EXPECT_TRUE(found_in(random_balls(1, 1), {})[0].empty());
  EXPECT_TRUE(found_in(random_balls(3, 0), test::sphere(100, 1).points)[2].empty());
}

}  // namespace
}  // namespace relievo
