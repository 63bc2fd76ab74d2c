#include "relievo/geometry/triangulation.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

#include "geometry/delaunay_builder.h"
#include "support/delaunay_check.h"
#include "support/planar_points.h"

namespace relievo {
namespace {

using Points = std::vector<Vec2>;

// Returns the triangles in sorted order, each beginning with its lowest corner.
std::set<Triangle> sorted_triangles(const Triangulation& triangulation) {
  std::set<Triangle> triangles;
  for (Triangle t : triangulation.triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.insert(t);
  }
  return triangles;
}

void expect_correct(const Points& points) {
  EXPECT_EQ(delaunay_fault(points, delaunay(points)), "");
}

// Returns twice the signed area. The result is exact for integers below 2^12.
double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return (a - d).squaredNorm() * twice_area(d, b, c) + (b - d).squaredNorm() * twice_area(d, c, a) +
         (c - d).squaredNorm() * twice_area(d, a, b);
}

// Returns the corners of the convex hull and the points on its edges, without duplicates, counter-clockwise
// from the leftmost point. Uses the monotone chain algorithm.
Points brute_hull(Points points) {
  const auto less = [](const Vec2& p, const Vec2& q) {
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const auto chain = [](auto begin, auto end) {
    Points half;
    for (; begin != end; ++begin) {
      while (half.size() > 1 && twice_area(half[half.size() - 2], half.back(), *begin) < 0) half.pop_back();
      half.push_back(*begin);
    }
    return half;
  };
  Points hull = chain(points.begin(), points.end());
  const Points upper = chain(points.rbegin(), points.rend());
  hull.insert(hull.end(), upper.begin() + 1, upper.end() - 1);
  return hull;
}

bool is_degenerate(const Points& points) {
  for (const Vec2& p : points)
    for (const Vec2& q : points)
      if (twice_area(points[0], p, q) != 0) return false;
  return true;
}

Points few_integer_points(int most, int limit) {
  const auto coordinate = rc::gen::inRange(-limit, limit + 1);
  const std::size_t n = *rc::gen::inRange(0, most);
  Points points(n);
  for (Vec2& p : points) p = Vec2(*coordinate, *coordinate);
  return points;
}

// All other tests rely on delaunay_fault(), so it must find every fault. Points in general position have only
// one Delaunay triangulation. So changing any number of this triangulation is a fault.
TEST(DelaunayCheck, RejectsAnyChangedNumber) {
  const Points points = random_points(60);
  const Triangulation right = delaunay(points);
  ASSERT_EQ(delaunay_fault(points, right), "");
  const int count = static_cast<int>(right.triangles.size());
  ASSERT_TRUE(rc::check([&] {
    Triangulation t = right;
    const int triangle = *rc::gen::inRange(0, count), corner = *rc::gen::inRange(0, 3);
    Index* const targets[] = {&t.triangles[triangle][corner], &t.neighbours[triangle][corner],
                              &t.hull[triangle % t.hull.size()]};
    Index& target = *targets[*rc::gen::inRange(0, 3)];
    const Index value =
        *rc::gen::oneOf(rc::gen::inRange(Index{0}, static_cast<Index>(count)), rc::gen::just(no_index));
    RC_PRE(value != target);
    target = value;
    RC_ASSERT(delaunay_fault(points, t) != "");
  }));
}

TEST(DelaunayCheck, RejectsWhatFailsOneCheckAlone) {
  constexpr Index none = no_index;
  const Triangulation good = {{{0, 1, 3}, {1, 2, 3}}, {{1, none, none}, {none, 0, none}}, {0, 1, 2, 3}};
  const Triangulation flipped = {{{0, 1, 2}, {0, 2, 3}}, {{none, 1, none}, {none, none, 0}}, {0, 1, 2, 3}};
  Points kite = {{-5, 0}, {0, -1}, {5, 0}, {0, 1}};
  EXPECT_EQ(delaunay_fault(kite, good), "");
  EXPECT_EQ(delaunay_fault(kite, flipped), "circle");
  Triangulation fewer = good, around_twice = good;
  fewer.triangles.pop_back(), fewer.neighbours = {{none, none, none}}, fewer.hull = {0, 1, 3};
  EXPECT_EQ(delaunay_fault(kite, fewer), "points");
  around_twice.hull = {0, 1, 2, 3, 0};
  EXPECT_EQ(delaunay_fault(kite, around_twice), "hull");
  kite.push_back(kite[2]);
  Triangulation twin = good;
  twin.triangles[1] = {1, 4, 3}, twin.hull = {0, 1, 4, 3};
  EXPECT_EQ(delaunay_fault(kite, twin), "points");
  EXPECT_EQ(delaunay_fault(Points{{-5, 0}, {0, 1}, {5, 0}, {0, 9}}, good), "turns") << "a notch at point 1";

  // Five triangles with an angle of 144 degrees each stand around a centre. Their only fault is that their
  // border goes around the centre twice.
  Points star = circle_points(5);
  star.emplace_back(0, 0);
  Triangulation t;
  for (Index k = 0; k < 5; ++k) {
    t.triangles.push_back({5, 2 * k % 5, 2 * (k + 1) % 5});
    t.neighbours.push_back({none, (k + 1) % 5, (k + 4) % 5});
    t.hull.push_back(2 * k % 5);
  }
  EXPECT_EQ(delaunay_fault(star, t), "turns");
}

TEST(Delaunay, AgreesWithBruteForceOnSmallIntegers) {
  for (const int limit : {1, 3, 40}) {
    ASSERT_TRUE(rc::check([&] {
      const Points points = few_integer_points(30, limit);
      const Triangulation result = delaunay(points);
      RC_ASSERT(result.triangles.empty() == is_degenerate(points));
      if (result.triangles.empty()) return;
      RC_ASSERT(delaunay_fault(points, result) == "");

      double twice_sum = 0, twice_hull_area = 0;
      for (const auto& [a, b, c] : result.triangles) {
        twice_sum += twice_area(points[a], points[b], points[c]);
        for (const Vec2& p : points) RC_ASSERT(in_circle(points[a], points[b], points[c], p) <= 0);
      }
      const Points expected_hull = brute_hull(points);
      for (std::size_t k = 2; k < expected_hull.size(); ++k)
        twice_hull_area += twice_area(expected_hull[0], expected_hull[k - 1], expected_hull[k]);
      RC_ASSERT(twice_sum == twice_hull_area);

      Points hull;
      for (const Index i : result.hull) hull.push_back(points[i]);
      const auto start = std::find(hull.begin(), hull.end(), expected_hull[0]);
      std::rotate(hull.begin(), start, hull.end());
      RC_ASSERT(hull == expected_hull);
    }));
  }
}

// Three points form a triangle of every Delaunay triangulation if no other point lies inside or on their
// circumcircle.
TEST(Delaunay, HasAllTrianglesWithAnEmptyClosedCircle) {
  ASSERT_TRUE(rc::check([] {
    Points points = few_integer_points(12, 4);
    const std::set<Triangle> triangles = sorted_triangles(delaunay(points));
    const auto n = static_cast<Index>(points.size());
    for (Index a = 0; a < n; ++a) {
      for (Index b = a + 1; b < n; ++b) {
        for (Index c = a + 1; c < n; ++c) {
          if (twice_area(points[a], points[b], points[c]) <= 0) continue;
          const auto is_outside = [&](const Vec2& p) {
            return in_circle(points[a], points[b], points[c], p) < 0;
          };
          const auto outside = std::count_if(points.begin(), points.end(), is_outside);
          if (outside == n - 3) RC_ASSERT(triangles.contains({a, b, c}));
        }
      }
    }
  }));
}

TEST(Delaunay, IsEmptyWithoutATriangle) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  Points line, tilted_line;
  for (int i = 0; i < 1000; ++i) line.emplace_back(i * 7 % 1000, 3);
  for (int i = 0; i < 1000; ++i) tilted_line.emplace_back(i * 7 % 1000 / 1024.0, i * 7 % 1000 * 3 + 1e6);
  const Points cases[] = {{},
                          {{1, 2}},
                          {{1, 2}, {3, 4}},
                          {{1, 2}, {3, 4}, {1, 2}, {3, 4}},
                          {{0, 0}, {1, 1}, {3, 3}},
                          Points(100, Vec2(0.1, 0.2)),
                          line,
                          tilted_line,
                          {{0, 0}, {1, 0}, {0, nan}},
                          {{0, 0}, {1, 0}, {0, infinite}},
                          {{0, 0}, {1, 0}, {0, 1e-61}},
                          {{0, 0}, {1, 0}, {0, 1e71}}};
  for (const Points& points : cases) {
    const Triangulation result = delaunay(points);
    EXPECT_TRUE(result.triangles.empty() && result.neighbours.empty() && result.hull.empty());
  }
}

TEST(Delaunay, TriangulatesAThinTriangleAtTheEndsOfTheRange) {
  for (const Points& points :
       {Points{{-1e70, 0}, {1e70, 0}, {0, 1e-60}}, Points{{0, 0}, {1e-60, 0}, {0, 1e-60}}}) {
    EXPECT_EQ(delaunay(points).triangles.size(), 1U);
    expect_correct(points);
  }
}

TEST(Delaunay, UsesTheFirstOfEqualPoints) {
  Points points = random_points(500);
  const std::set<Triangle> expected = sorted_triangles(delaunay(points));
  for (int copies = 0; copies < 3; ++copies)
    for (std::size_t i = 0; i < 500; ++i) points.push_back(points[i * 7 % 500]);
  points.emplace_back(points[0]);
  EXPECT_EQ(sorted_triangles(delaunay(points)), expected);
  expect_correct(points);

  EXPECT_EQ(delaunay(Points{{0, 0}, {1, 0}, {0, 1}, {-0.0, 0.0}}).triangles.size(), 1U);
}

TEST(Delaunay, CoversGrids) {
  for (const auto& [width, height] : {std::pair(100, 100), std::pair(1000, 2), std::pair(3, 777)}) {
    const Points points = grid_points(width, height);
    const Triangulation result = delaunay(points);
    EXPECT_EQ(result.triangles.size(), 2U * (width - 1) * (height - 1));
    EXPECT_EQ(result.hull.size(), 2U * (width + height) - 4);
    EXPECT_EQ(delaunay_fault(points, result), "");
  }
}

// Neighbouring points of this grid differ only in the last bit of a coordinate.
TEST(Delaunay, CoversAGridOfNeighbouringDoubles) {
  Points points = grid_points(40, 40);
  for (Vec2& p : points) p = Vec2(0.3, 0.4) + p * 0x1p-54;
  const Triangulation result = delaunay(points);
  EXPECT_EQ(result.triangles.size(), 2U * 39 * 39);
  EXPECT_EQ(delaunay_fault(points, result), "");
}

TEST(Delaunay, IsCorrectOnHardSets) {
  Points two_lines, parabola, rotated_grid = grid_points(60, 60), far = random_points(3000), noisy_far;
  for (int i = 0; i < 3000; ++i) two_lines.emplace_back(i / 2, i % 2 * 100);
  for (int i = 0; i < 3000; ++i) parabola.emplace_back(i, i * i);
  for (Vec2& p : rotated_grid) p = Vec2(0.8 * p.x() - 0.6 * p.y(), 0.6 * p.x() + 0.8 * p.y());
  for (Vec2& p : far) p += Vec2(1e6, -1e6);
  for (const Vec2& p : far) noisy_far.push_back(Vec2(1e15, 1e15) + 100 * (p - far[0]));
  Points star = circle_points(3000);
  for (std::size_t i = 0; i < star.size(); i += 3) star[i] *= static_cast<double>(i) / 3000;

  for (const Points& points : {two_lines, parabola, rotated_grid, far, noisy_far, circle_points(5000), star,
                               clustered_points(5000)}) {
    expect_correct(points);
  }
}

TEST(Delaunay, DoesNotDependOnTheOrderOfThePoints) {
  const Points points = random_points(2000);
  Points permuted(points.size());
  const auto place = [&](Index i) { return static_cast<Index>(i * 1237 % points.size()); };
  for (Index i = 0; i < points.size(); ++i) permuted[place(i)] = points[i];

  Triangulation renamed = delaunay(points);
  for (Triangle& t : renamed.triangles) t = {place(t[0]), place(t[1]), place(t[2])};
  EXPECT_EQ(sorted_triangles(delaunay(permuted)), sorted_triangles(renamed));
}

TEST(Delaunay, DoesNotDependOnExactMovesAndScales) {
  std::mt19937_64 random(5);
  Points points(2000);
  for (Vec2& p : points)
    p = Vec2(static_cast<double>(random() % (1U << 30)), static_cast<double>(random() % (1U << 30)));
  const std::set<Triangle> expected = sorted_triangles(delaunay(points));

  const auto triangles_of = [&](auto&& map) {
    Points mapped;
    for (const Vec2& p : points) mapped.push_back(map(p));
    return sorted_triangles(delaunay(mapped));
  };
  EXPECT_EQ(triangles_of([](const Vec2& p) { return Vec2(p + Vec2(1e12, -3e13)); }), expected);
  EXPECT_EQ(triangles_of([](const Vec2& p) { return Vec2(p * 0x1p150); }), expected);
  EXPECT_EQ(triangles_of([](const Vec2& p) { return Vec2(p * 0x1p-150); }), expected);
  EXPECT_EQ(triangles_of([](const Vec2& p) { return Vec2(-p.y(), p.x()); }), expected);
}

// Either diagonal of four points on a circle is Delaunay. The choice must be the same on every machine;
// `picture` shows it for the cells of a grid. If the order of insertion changes, the picture may change.
TEST(Delaunay, ChoosesTheSameDiagonalsEverywhere) {
  const int side = 6;
  const Points points = grid_points(side, side);
  std::string picture((side - 1) * side, '\n');  // the lowest row first
  for (const auto& [a, b, c] : delaunay(points).triangles) {
    const Vec2 low = points[a].cwiseMin(points[b]).cwiseMin(points[c]), high = low + Vec2(1, 1);
    const auto is_corner = [&](const Vec2& p) { return points[a] == p || points[b] == p || points[c] == p; };
    picture[static_cast<std::size_t>(low.y() * side + low.x())] =
        is_corner(low) && is_corner(high) ? '/' : '\\';
  }
  EXPECT_EQ(picture, R"(/\/\/
\////
\\/\/
\/\//
/\/\\
)");
}

// After each insertion, the triangulation is that of the points so far. Only triangles that
// each_around_newest() visits have changed their corners.
TEST(DelaunayBuilder, GrowsPointByPoint) {
  const Points all = random_points(300, 17);
  Points points(all.begin(), all.begin() + 3);
  DelaunayBuilder builder(points, {0, 1, 2});
  ASSERT_TRUE(builder.start());
  std::vector<Triangle> corners;
  for (Index i = 3; i < all.size(); ++i) {
    points.push_back(all[i]);
    corners.resize(builder.size());
    for (Index t = 0; t < builder.size(); ++t) corners[t] = builder.corners(t);
    ASSERT_TRUE(builder.insert_added(i, i * 7 % builder.size()));
    std::set<Index> changed;
    builder.each_around_newest([&](Index t) { changed.insert(t); });
    for (Index t = 0; t < builder.size(); ++t)
      ASSERT_TRUE(changed.contains(t) || (t < corners.size() && builder.corners(t) == corners[t])) << i;
  }
  EXPECT_EQ(delaunay_fault(all, builder.result()), "");
  EXPECT_EQ(sorted_triangles(builder.result()), sorted_triangles(delaunay(all)));
  points.push_back(all[5]);
  EXPECT_FALSE(builder.insert_added(static_cast<Index>(all.size()), 0));
}

}  // namespace
}  // namespace relievo
