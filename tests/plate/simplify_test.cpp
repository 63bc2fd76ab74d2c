#include "relievo/plate/simplify.h"

#include <rapidcheck.h>

#include <array>

#include "support/plate_fronts.h"
#include "support/shapes.h"
#include "support/triangles.h"

namespace relievo {
namespace {

using test::flat_front, test::grid_front;

// Returns the Delaunay triangulation of scattered points, and of a rectangle around them on the ground.
HeightFieldMesh scattered_front(int n, const std::function<double(double, double)>& z,
                                std::uint64_t seed = 7) {
  test::Random random(seed);
  std::vector<Vec3> points = {{0, 0, 0}, {60, 0, 0}, {60, 40, 0}, {0, 40, 0}};
  for (int i = 0; i < n; ++i) {
    const double x = random.uniform(.5, 59.5), y = random.uniform(.5, 39.5);
    points.emplace_back(x, y, z(x, y));
  }
  return test::front_over(points);
}

double waves(double x, double y) {
  return std::sin(x / 4) * std::cos(y / 5) + (x > 30 ? 1 : 0);
}

double height_at(const HeightFieldMesh& front, const Vec2& place) {
  return test::height_at(front.points, front.triangles, place);
}

TEST(Simplify, FlatGroundBecomesTwoTriangles) {
  const auto simpler = value_of(simplify(flat_front({60, 40, 30, 20}), .01));
  EXPECT_EQ(simpler.front.triangles.size(), 2U);
  EXPECT_EQ(simpler.error_mm, 0);
}

// The sides of this front are straight only up to rounding. So a point on a side may lie slightly outside all
// triangles of the other points.
TEST(Simplify, TakesAHullThatIsStraightUpToRounding) {
  const auto simpler =
      simplify(test::turned_grid_front(60, .5, [](double x, double y) { return waves(9 * x, 9 * y); }), .1);
  ASSERT_TRUE(simpler) << simpler.error().message();
  EXPECT_LE(simpler->error_mm, .1);
}

TEST(Simplify, FlatGroundStaysFlat) {
  const auto dome = [](double x, double y) { return std::max(0., 1 - std::hypot(x - 30, y - 20) / 9); };
  const HeightFieldMesh full = scattered_front(8000, dome);
  const auto simpler = value_of(simplify(full, .05));
  EXPECT_LT(simpler.front.triangles.size(), full.triangles.size() / 4);
  test::Random random(3);
  int level = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec2 place(random.uniform(0, 60), random.uniform(0, 40));
    if (height_at(full, place) != 0) continue;
    EXPECT_EQ(height_at(simpler.front, place), 0) << place.transpose();
    ++level;
  }
  EXPECT_GT(level, 1000);
}

// Returns the edges of all triangles. An edge of two triangles is returned twice.
std::vector<std::array<Vec2, 2>> edges_of(const HeightFieldMesh& front) {
  std::vector<std::array<Vec2, 2>> edges;
  for (const Triangle& t : front.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back({front.points[t[i]].head<2>(), front.points[t[(i + 1) % 3]].head<2>()});
  return edges;
}

// The difference of two piecewise linear surfaces is largest at a point of one of them, or where an edge of
// one crosses an edge of the other. So all these points are tested.
TEST(Simplify, TheErrorToldIsTheLargestDifference) {
  const HeightFieldMesh full = scattered_front(80, waves);
  const auto simpler = value_of(simplify(full, .4));
  double largest = 0;
  const auto compare = [&](const Vec2& place) {
    const double error = std::abs(height_at(full, place) - height_at(simpler.front, place));
    if (error > largest) largest = error;  // ignores NaN, at points that rounding put outside
  };
  for (const Vec3& p : full.points) compare(p.head<2>());
  for (const auto& [a, b] : edges_of(full))
    for (const auto& [c, d] : edges_of(simpler.front)) {
      const Vec2 u = b - a, v = d - c, w = c - a;
      const double area = cross(u, v), share = cross(w, v) / area, other = cross(w, u) / area;
      if (share > 0 && share < 1 && other > 0 && other < 1) compare(a + share * u);
    }
  EXPECT_GT(largest, .1);
  EXPECT_NEAR(simpler.error_mm, largest, 1e-9);
}

// All points of this front are needed. The corners of a cell lie on a circle, so a Delaunay triangulation may use the
// other diagonal of the cell. With the other diagonals, simplify() would need more triangles than the front has.
TEST(Simplify, NeverAddsTriangles) {
  const HeightFieldMesh saddle =
      grid_front({40, 40, 20, 20}, [](double x, double y) { return std::fmod(x * 7 + y * 3, 5); });
  for (const double tolerance : {.5, .1, 1e-9}) {
    const auto simpler = value_of(simplify(saddle, tolerance));
    EXPECT_LE(simpler.front.triangles.size(), saddle.triangles.size()) << tolerance;
    EXPECT_LE(simpler.error_mm, tolerance);
  }
}

// With as many triangles as a tolerance needs, a limit for their number must find errors that are about as small.
TEST(Simplify, ALimitForTrianglesSpreadsTheErrorEvenly) {
  const HeightFieldMesh full = scattered_front(20000, waves);
  for (const double tolerance : {.2, .05, .02}) {
    const auto within = value_of(simplify(full, tolerance));
    SimplifyOptions options{1e-6};
    options.most_triangles = within.front.triangles.size();
    const auto limited = value_of(simplify(full, options));
    EXPECT_LE(limited.front.triangles.size(), options.most_triangles);
    EXPECT_LT(limited.error_mm, 1.5 * tolerance);
  }
}

TEST(Simplify, ColoursFollowTheirPoints) {
  HeightFieldMesh full = scattered_front(300, waves);
  for (const Vec3& p : full.points) full.colours.push_back({static_cast<std::uint8_t>(p.x() * 4), 0, 9});
  const auto simpler = value_of(simplify(full, .05));
  ASSERT_EQ(simpler.front.colours.size(), simpler.front.points.size());
  for (std::size_t i = 0; i < simpler.front.points.size(); ++i)
    EXPECT_NEAR(simpler.front.colours[i][0], 4 * simpler.front.points[i].x(), 1.6);
}

TEST(Simplify, RefusesWhatItCannotDo) {
  EXPECT_EQ(simplify(flat_front({1, 1, 1, 1}), 0).error().kind, ErrorKind::option);
  EXPECT_EQ(simplify(flat_front({1, 1, 1, 1}), std::nan("")).error().kind, ErrorKind::option);
  EXPECT_EQ(simplify({}, .1).error().kind, ErrorKind::geometry);
  Cancelled progress;
  EXPECT_EQ(simplify(flat_front({1, 1, 1, 1}), .1, &progress).error().kind, ErrorKind::cancelled);
}

TEST(SimplifyProperty, AnyScatterStaysWithinItsTolerance) {
  ASSERT_TRUE(rc::check([] {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    test::Random heights(seed);
    const HeightFieldMesh full = scattered_front(
        *rc::gen::inRange(0, 200), [&](double, double) { return heights.uniform(); }, seed);
    const double tolerance = *rc::gen::inRange(1, 100) / 100.0;
    const auto simpler = simplify(full, tolerance);
    RC_ASSERT(simpler.has_value());
    RC_ASSERT(simpler->error_mm <= tolerance);
    for (const Vec3& p : full.points) {
      const Vec2 place = p.head<2>().cwiseMax(Vec2(1e-9, 1e-9)).cwiseMin(Vec2(60 - 1e-9, 40 - 1e-9));
      RC_ASSERT(std::abs(height_at(simpler->front, place) - p.z()) <= tolerance + 1e-6);
    }
  }));
}

double steepest(const HeightFieldMesh& front) {
  double most = 0;
  for (const Triangle& t : front.triangles) {
    const Vec3 p = front.points[t[1]] - front.points[t[0]], q = front.points[t[2]] - front.points[t[0]];
    const double area = p.x() * q.y() - p.y() * q.x();
    most = std::max(most, Vec2(p.z() * q.y() - q.z() * p.y(), q.z() * p.x() - p.z() * q.x()).norm() / area);
  }
  return most;
}

TEST(Simplify, MakesNoTriangleSteeperThanAsked) {
  // Returns the height of folds of slope 1.1. At the rim, ramps of slope 1 cut the folds off.
  const auto folds = [](double x, double y) {
    const double along = x + .5 * y + 100;
    return std::min({std::abs(along - 6 * std::round(along / 6)), x, 60 - x, y, 40 - y});
  };
  const HeightFieldMesh full = test::grid_front({60, 40, 120, 80}, folds);
  const double limit = 1.0001 * steepest(full), tolerance = .3;
  EXPECT_GT(steepest(simplify(full, tolerance)->front), 1.3 * limit);
  const auto simpler = value_of(simplify(full, SimplifyOptions{tolerance, limit}));
  EXPECT_LE(steepest(simpler.front), limit * (1 + 1e-4));
  EXPECT_LE(simpler.error_mm, tolerance);
  EXPECT_LT(simpler.front.triangles.size(), full.triangles.size() / 2);
}

}  // namespace
}  // namespace relievo
