#include "paper/heights.h"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>

#include "support/planar_points.h"
#include "support/results.h"
#include "support/same_bits.h"

namespace relievo::paper {
namespace {

// Solves equation (9) as printed in the paper. The system has one equation for each boundary point, and one
// for each pair of a point and one of its six nearest points. The nearest points are found by sorting.
Eigen::VectorXd dense_heights(const std::vector<Vec2>& points, const std::vector<std::uint8_t>& is_boundary,
                              const std::vector<Vec2f>& slopes) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(7 * n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(7 * n);
  for (Eigen::Index p = 0; p < n; ++p) {
    const auto at = [&](Eigen::Index i) { return points[static_cast<std::size_t>(i)]; };
    std::vector<Eigen::Index> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](Eigen::Index q) { return (at(q) - at(p)).squaredNorm(); });
    for (Eigen::Index i = 1; i <= 6; ++i) {  // order[0] is the point itself
      const Eigen::Index q = order[static_cast<std::size_t>(i)], row = 7 * p + i;
      A(row, p) = 1, A(row, q) = -1;
      b(row) = slopes[static_cast<std::size_t>(p)].cast<double>().dot(at(p) - at(q));
    }
    A(7 * p, p) = is_boundary[static_cast<std::size_t>(p)];
  }
  return A.colPivHouseholderQr().solve(b);
}

std::vector<float> solved(const NormalEquations& equations, std::span<const Vec2f> slopes) {
  std::vector<float> heights(slopes.size());
  auto workspace = equations.make_workspace();
  equations.solve(slopes, heights, workspace);
  return heights;
}

std::vector<Vec2f> random_slopes(std::size_t n) {
  std::vector<Vec2f> slopes;
  for (const Vec2& v : random_points(n, 3)) slopes.push_back((2 * v - Vec2::Ones()).cast<float>());
  return slopes;
}

TEST(PaperHeights, AreTheLeastSquaresOfEquation9) {
  const std::vector<Vec2> points = random_points(90);
  std::vector<std::uint8_t> is_boundary(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); i += 7) is_boundary[i] = 1;
  const std::vector<Vec2f> slopes = random_slopes(points.size());
  const auto expected = dense_heights(points, is_boundary, slopes);
  const auto heights = solved(value_of(NormalEquations::build(points, is_boundary)), slopes);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(heights[i], expected(static_cast<Eigen::Index>(i)), 1e-5);
}

// There are two distant clusters of points. One of them has no boundary point, so its first point gets height 0.
TEST(PaperHeights, AreDefiniteWithoutBoundary) {
  std::vector<Vec2> points = random_points(40);
  for (std::size_t i = 20; i < 40; ++i) points[i].x() += 100;
  std::vector<std::uint8_t> is_boundary(40, 0), with_first(40, 0);
  is_boundary[3] = with_first[3] = with_first[20] = 1;
  const std::vector<Vec2f> slopes = random_slopes(40);
  const auto expected = dense_heights(points, with_first, slopes);
  const auto heights = solved(value_of(NormalEquations::build(points, is_boundary)), slopes);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(heights[i], expected(static_cast<Eigen::Index>(i)), 1e-5);
}

TEST(PaperHeights, HaveTheSameBitsWithAnyNumberOfThreads) {
  const std::vector<Vec2> points = random_points(20000);
  std::vector<std::uint8_t> is_boundary(points.size(), 0);
  is_boundary[5] = 1;
  const NormalEquations equations = value_of(NormalEquations::build(points, is_boundary));
  const std::vector<Vec2f> slopes = random_slopes(points.size());
  test::expect_same_for_any_threads([&] { return solved(equations, slopes); });
}

}  // namespace
}  // namespace relievo::paper
