#include "solver/dissection.h"

#include <gtest/gtest.h>

#include <Eigen/OrderingMethods>

#include "geometry/hilbert.h"
#include "support/planar_systems.h"

namespace relievo::solver {
namespace {

using test::jittered_grid;
using test::PlanarSystem;

// Returns the number of entries of the Cholesky factor below the diagonal. Counts them by symbolic elimination.
std::size_t fill_of(const Graph& graph, std::span<const Index> order) {
  const auto n = static_cast<Index>(order.size());
  std::vector<Index> place(n);
  for (Index i = 0; i < n; ++i) place[order[i]] = i;
  std::vector<std::vector<Index>> rows(n);
  std::size_t total = 0;
  for (Index j = 0; j < n; ++j) {
    for (const Index u : graph.neighbours(order[j]))
      if (place[u] > j) rows[j].push_back(place[u]);
    std::sort(rows[j].begin(), rows[j].end());
    rows[j].erase(std::unique(rows[j].begin(), rows[j].end()), rows[j].end());
    total += rows[j].size();
    if (rows[j].empty()) continue;
    const Index parent = rows[j].front();
    rows[parent].insert(rows[parent].end(), rows[j].begin() + 1, rows[j].end());
    rows[j] = {};
  }
  return total;
}

std::vector<Index> minimum_degree(const test::Sparse& A) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(A.selfadjointView<Eigen::Lower>(), permutation);
  std::vector<Index> order(static_cast<std::size_t>(A.cols()));
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<Index>(permutation.indices()[static_cast<Eigen::Index>(i)]);
  return order;
}

std::vector<Index> ordered(const Graph& graph, const std::vector<Vec2>& positions) {
  return dissection_order(graph, in_unit_square(positions));
}

void expect_permutation(std::vector<Index> order, std::size_t n) {
  ASSERT_EQ(order.size(), n);
  std::sort(order.begin(), order.end());
  for (Index i = 0; i < n; ++i) ASSERT_EQ(order[i], i);
}

TEST(Dissection, OrdersEveryVertexOnce) {
  for (const auto& [width, height] : {std::pair(1, 1), {1, 300}, {40, 40}, {300, 20}}) {
    const PlanarSystem system = jittered_grid(width, height);
    const Graph graph = test::graph_of(system.A);
    expect_permutation(ordered(graph, system.positions), graph.size());
    expect_permutation(ordered(graph, test::shuffled(system.positions)), graph.size());
    expect_permutation(ordered(graph, std::vector<Vec2>(graph.size(), Vec2(1, 1))), graph.size());
  }
  EXPECT_TRUE(dissection_order({}, {}).empty());
}

TEST(Dissection, FillsLessThanMinimumDegree) {
  const PlanarSystem system = jittered_grid(300, 300);
  const Graph graph = test::graph_of(system.A);
  const std::size_t ours = fill_of(graph, ordered(graph, system.positions));
  EXPECT_LT(static_cast<double>(ours), .95 * static_cast<double>(fill_of(graph, minimum_degree(system.A))));
}

// If positions coincide or are wrong, distances in the graph are used instead. They increase the fill by up to 60 %.
TEST(Dissection, NeedsNoPositionsForAModestFill) {
  const PlanarSystem system = jittered_grid(100, 100);
  const Graph graph = test::graph_of(system.A);
  const double good = static_cast<double>(fill_of(graph, ordered(graph, system.positions)));
  EXPECT_LT(static_cast<double>(fill_of(graph, ordered(graph, std::vector<Vec2>(graph.size(), Vec2(0, 0))))),
            1.6 * good);
  const auto wrong = ordered(graph, test::shuffled(system.positions));
  EXPECT_LT(static_cast<double>(fill_of(graph, wrong)), 1.6 * good);
}

TEST(Bisection, PartsAGridAcrossItsShortSide) {
  const PlanarSystem system = jittered_grid(90, 30);
  for (const double degrees : {0, 30, 60, 90, 135}) {
    const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
    std::vector<Vec2> turned;
    for (const Vec2& p : system.positions) turned.push_back(turn * p);
    const Bisection cut = bisect(test::graph_of(system.A), in_unit_square(turned));
    EXPECT_EQ(cut.separator, 30U) << degrees;
    EXPECT_GT(std::min(cut.first, cut.second), 900U) << degrees;
  }
}

TEST(Bisection, LeavesNoEdgeBetweenTheSides) {
  const PlanarSystem system = jittered_grid(40, 40);
  const Graph graph = test::graph_of(system.A);
  for (const auto& positions : {system.positions, test::shuffled(system.positions)}) {
    const Bisection cut = bisect(graph, in_unit_square(positions));
    EXPECT_EQ(cut.first + cut.second + cut.separator, graph.size());
    for (Index v = 0; v < graph.size(); ++v)
      for (const Index u : graph.neighbours(v))
        ASSERT_FALSE(cut.side[v] == Side::first && cut.side[u] == Side::second);
  }
}

}  // namespace
}  // namespace relievo::solver
