#include "geometry/lattice.h"

#include <gtest/gtest.h>

#include "geometry/plane.h"
#include "support/shapes.h"

namespace relievo {
namespace {

constexpr double cell = .1;

// Random points in a square of side 2, and a lattice over them. Two of every three points count for the lattice.
struct Scattered {
  std::vector<Vec3> points = test::sheet(3000, 1, 0).points;
  std::vector<Index> counted = two_of_three(points.size());
  Lattice lattice{points, counted, cell};

  static std::vector<Index> two_of_three(std::size_t n) {
    std::vector<Index> some;
    for (Index i = 0; i < n; ++i)
      if (i % 3 != 0) some.push_back(i);
    return some;
  }

  template <typename F>
  std::vector<Lattice::Tile> refined(F value) const {
    std::vector<float> nodes(lattice.nodes());
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = static_cast<float>(value(n));
    std::vector<Lattice::Tile> tiles(nodes.size());
    lattice.refine(nodes, tiles);
    return tiles;
  }

  // Returns a point's position in units of cells: at() interpolates the column and row numbers of the nodes.
  Vec2 place(std::size_t point) const { return {lattice.at(point, columns), lattice.at(point, rows)}; }

  std::vector<Lattice::Tile> columns = refined([&](std::size_t n) { return n % lattice.width(); });
  std::vector<Lattice::Tile> rows = refined([&](std::size_t n) { return n / lattice.width(); });
};

std::vector<double> some_values(std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<double>(i * 7919 % 1000) / 1000 - .3;
  return values;
}

// B-splines reproduce linear functions. So a point's position in cells is a scaled and shifted copy of its
// position in the plane.
TEST(Lattice, IsLinearBetweenItsNodes) {
  const Scattered s;
  const Vec2 first = s.place(0);
  for (std::size_t i = 1; i < s.points.size(); ++i) {
    const Vec2 step = (s.points[i] - s.points[0]).head<2>() / cell;
    ASSERT_LT((s.place(i) - first - step).norm(), 1e-4);
  }
}

// A cubic B-spline with the coefficients n^2 is the parabola x^2 + 1/3. The values of at() must be at
// least those of this parabola, and may exceed them by at most 1/64.
TEST(Lattice, IsSmoothBetweenItsNodes) {
  const Scattered s;
  const auto squares = s.refined([&](std::size_t n) {
    const std::size_t column = n % s.lattice.width();
    return column * column;
  });
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    const float x = s.lattice.at(i, s.columns), above = s.lattice.at(i, squares) - (x * x + 1 / 3.F);
    ASSERT_GE(above, -1e-3);
    ASSERT_LE(above, 1 / 64.F + 1e-3);
  }
}

// The expected values follow the definition of the mean: each node is computed from all counted points.
TEST(Lattice, GathersMeansBySquaredWeights) {
  const Scattered s;
  const std::vector<double> values = some_values(s.points.size());
  std::vector<float> nodes(s.lattice.nodes());
  std::vector<Lattice::Corners> sums(nodes.size());
  s.lattice.gather(std::span(values), sums, nodes);
  std::vector<double> sum(nodes.size(), 0.0), weight(nodes.size(), 0.0);
  for (const Index i : s.counted) {
    const Vec2 p = s.place(i);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Vec2 away(p.x() - static_cast<double>(n % s.lattice.width()),
                      p.y() - static_cast<double>(n / s.lattice.width()));
      const Vec2 share = (Vec2::Ones() - away.cwiseAbs()).cwiseMax(0);
      const double w = share.x() * share.y() * share.x() * share.y();
      sum[n] += w * values[i], weight[n] += w;
    }
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (weight[n] > 1e-6) {
      EXPECT_TRUE(s.lattice.is_reached(n));
      EXPECT_NEAR(nodes[n], sum[n] / weight[n], 1e-4);
    } else if (!s.lattice.is_reached(n)) {
      EXPECT_EQ(nodes[n], 0);
    }
  }
}

TEST(Lattice, FindsWhatValuesDoBetweenNodes) {
  const Scattered s;
  const std::vector<double> values = some_values(s.points.size());
  std::vector<float> nodes(s.lattice.nodes());
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = static_cast<float>(n % 11) / 11;
  std::vector<Lattice::Extent> cells(nodes.size());
  s.lattice.compare(std::span(values), nodes, cells);
  std::vector<float> lowest(nodes.size(), 1e9F), highest(nodes.size(), -1e9F);
  for (const Index i : s.counted) {
    const Vec2 p = s.place(i), whole = p.array().floor(), t = p - whole;
    const std::size_t w = s.lattice.width(),
                      c = static_cast<std::size_t>(whole.x()) + w * static_cast<std::size_t>(whole.y());
    const auto node = [&](std::size_t n) { return static_cast<double>(nodes[n]); };
    const double between = (1 - t.y()) * ((1 - t.x()) * node(c) + t.x() * node(c + 1)) +
                           t.y() * ((1 - t.x()) * node(c + w) + t.x() * node(c + w + 1));
    const auto rest = static_cast<float>(values[i] - between);
    lowest[c] = std::min(lowest[c], rest), highest[c] = std::max(highest[c], rest);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (lowest[c] > highest[c]) {
      EXPECT_GT(cells[c].lowest, cells[c].highest);
      continue;
    }
    EXPECT_NEAR(cells[c].lowest, lowest[c], 1e-4);
    EXPECT_NEAR(cells[c].highest, highest[c], 1e-4);
  }
}

// A node inside the lattice is a corner of four cells. It is the first corner of one of them, the second
// corner of another, and so on.
TEST(Lattice, KnowsTheCellsAroundANode) {
  const Scattered s;
  const std::size_t w = s.lattice.width(), node = 3 * w + 5;
  std::vector<std::pair<std::size_t, std::size_t>> found;
  s.lattice.each_cell(node, [&](std::size_t c, std::size_t corner) { found.emplace_back(c, corner); });
  ASSERT_EQ(found.size(), 4U);
  for (const auto& [c, corner] : found) EXPECT_EQ(c + corner % 2 + corner / 2 * w, node);
  s.lattice.each_cell(0, [](std::size_t c, std::size_t) { EXPECT_EQ(c, 0U); });
}

TEST(Lattice, FindsTheNodesAroundAPoint) {
  const Scattered s;
  for (const std::size_t point : {0U, 77U, 2999U}) {
    std::vector<std::uint8_t> marks(s.lattice.nodes());
    s.lattice.mark_nodes_around(point, marks);
    for (std::size_t n = 0; n < marks.size(); ++n) {
      const Vec2 away = s.place(point) - Vec2(n % s.lattice.width(), n / s.lattice.width());
      const bool is_around = away.x() >= 0 && away.x() < 1 && away.y() >= 0 && away.y() < 1;
      const bool is_next = std::abs(away.x()) <= 1 && std::abs(away.y()) <= 1;
      EXPECT_TRUE(marks[n] ? is_next : !is_around) << point << ' ' << n;
    }
    EXPECT_EQ(std::ranges::count(marks, 1), 4);
  }
}

// The expected nodes are those inside the triangle. place() gives the triangle's corners in units of cells.
// In these units, the coordinates of a node are its column and its row.
TEST(Lattice, FindsTheNodesInATriangle) {
  const Scattered s;
  for (Index first = 0; first + 2 < 300; first += 3) {
    Triangle t{first, first + 1, first + 2};
    if (cross(s.place(t[1]) - s.place(t[0]), s.place(t[2]) - s.place(t[0])) < 0) std::swap(t[1], t[2]);
    std::vector<std::uint8_t> found(s.lattice.nodes(), 0);
    s.lattice.mark_nodes_in(t, found);
    for (std::size_t n = 0; n < found.size(); ++n) {
      const Vec2 p(static_cast<double>(n % s.lattice.width()), static_cast<double>(n / s.lattice.width()));
      double nearest = 1e9;  // distance to the nearest side, positive inside
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = s.place(t[k]), side = s.place(t[(k + 1) % 3]) - a;
        nearest = std::min(nearest, cross(side, p - a) / side.norm());
      }
      if (std::abs(nearest) < 1e-3) continue;
      ASSERT_EQ(found[n] != 0, nearest > 0);
    }
  }
}

// Cubic B-splines add up to 1 and reproduce linear functions. So the amounts at the nodes add up to the
// given amount, and their centroid is the given position.
TEST(Lattice, SpreadsAmountsAroundTheirPlace) {
  const Scattered s;
  for (const Vec2& place : {Vec2(3, 4), Vec2(5.25, 2.9), Vec2(7.999, 8.5)}) {
    std::vector<float> nodes(s.lattice.nodes());
    s.lattice.spread(place, 2, nodes);
    Vec2 moment(0, 0);
    double sum = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto amount = static_cast<double>(nodes[n]);
      sum += amount, moment += amount * Vec2(n % s.lattice.width(), n / s.lattice.width());
    }
    EXPECT_NEAR(sum, 2, 1e-5);
    EXPECT_LT((moment / sum - place).norm(), 1e-5);
  }
}

TEST(Lattice, OfNothingHasNothing) {
  const Lattice lattice({}, {}, 1);
  for (std::size_t n = 0; n < lattice.nodes(); ++n) EXPECT_FALSE(lattice.is_reached(n));
}

}  // namespace
}  // namespace relievo
