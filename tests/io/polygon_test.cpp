// Checks by areas that triangles cover polygons, among them polygons that a fan of triangles does not cover.
#include "io/polygon.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace relievo::io {
namespace {

using Polygon = std::vector<Vec3>;

// Returns twice the vector area of a polygon.
Vec3 area_of(const Polygon& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += p[i].cross(p[(i + 1) % p.size()]);
  return sum;
}

// Expects that triangulate() covers the polygon, which must not cross itself. If no triangle is reversed,
// and the areas of the triangles add up to that of the polygon, they cover it without overlaps.
void expect_covered(const Polygon& polygon, const char* what) {
  const auto triangles = triangulate(polygon);
  const Vec3 area = area_of(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2) << what;
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const double part =
        (polygon[b] - polygon[a]).cross(polygon[c] - polygon[a]).dot(area) / area.squaredNorm();
    EXPECT_GE(part, -1e-6) << what;
    sum += std::abs(part);
  }
  EXPECT_NEAR(sum, 1, 1e-5) << what;
}

// Expects that a polygon in a tilted plane is covered, whichever corner comes first, and in both orientations.
void expect_covered_in_every_way(Polygon polygon, const char* what) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(.3, -.5, .7, .2).normalized();
  for (Vec3& p : polygon) p = turn * p + Vec3(300, -20, 7);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    expect_covered(polygon, what);
  }
  std::reverse(polygon.begin(), polygon.end());
  expect_covered(polygon, what);
}

const Polygon c_shape = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0},
                         {1, 2, 0}, {3, 2, 0}, {3, 3, 0}, {0, 3, 0}};

Polygon comb(int teeth) {
  Polygon polygon = {{0, -1, 0}, {2. * teeth, -1, 0}};
  for (int i = teeth; i-- > 0;) {
    polygon.emplace_back(2 * i + 1.9, 0, 0);
    polygon.emplace_back(2 * i + 1, 9, 0);
    polygon.emplace_back(2 * i + .1, 0, 0);
  }
  return polygon;
}

Polygon spiral(int corners) {
  Polygon polygon;
  const auto add = [&](int i, double width) {
    const double angle = .25 * i, radius = 1 + .3 * angle + width;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  for (int i = 0; i < corners / 2; ++i) add(i, .8);
  for (int i = corners / 2; i-- > 0;) add(i, 0);
  return polygon;
}

// A square with a hole. A seam of two coincident edges connects the hole with the outline.
const Polygon wall_with_a_hole = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0},
                                  {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}};

TEST(Triangulate, FansOutWhatAFanCovers) {
  const Polygon square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(square), (std::vector<std::array<Index, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(triangulate(std::span(square).first(3)), (std::vector<std::array<Index, 3>>{{0, 1, 2}}));
  EXPECT_TRUE(triangulate(std::span(square).first(2)).empty());
  EXPECT_TRUE(triangulate({}).empty());
}

TEST(Triangulate, CoversConcavePolygons) {
  const Polygon arrow = {{0, 0, 0}, {2, 2, 0}, {0, 1, 0}, {-2, 2, 0}};
  const Polygon with_flat_corners = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0},
                                     {1, 1, 0}, {1, 2, 0}, {1, 3, 0}, {0, 3, 0}, {0, 2, 0}, {0, 1, 0}};
  expect_covered_in_every_way(arrow, "arrow");
  expect_covered_in_every_way(c_shape, "C");
  expect_covered_in_every_way(comb(9), "comb");
  expect_covered_in_every_way(spiral(120), "spiral");
  expect_covered_in_every_way(with_flat_corners, "flat corners");
}

TEST(Triangulate, CoversPolygonsWithHolesOnSeams) {
  expect_covered_in_every_way(wall_with_a_hole, "hole");
  Polygon two = wall_with_a_hole;  // adds a second seam from the same corner of the outline
  two.insert(two.begin() + 5, {{1, 2, 0}, {1, 8, 0}, {2, 8, 0}, {1, 2, 0}, {0, 0, 0}});
  expect_covered_in_every_way(two, "two holes");
}

TEST(Triangulate, CoversRandomStars) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    Polygon star;
    const int corners = 4 + i % 40;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double radius = std::uniform_real_distribution(.05, 1.)(random);
      star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    expect_covered_in_every_way(star, "star");
  }
}

TEST(Triangulate, FansOutWhatNothingCovers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Polygon bow_tie = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const Polygon line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  Polygon broken = c_shape, huge = c_shape;
  broken[2].x() = nan;
  for (Vec3& p : huge) p *= 1e200;
  for (const Polygon& polygon : {bow_tie, line, broken, huge, Polygon(8, Vec3(1, 2, 3))}) {
    const auto triangles = triangulate(polygon);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    for (Index i = 0; i < triangles.size(); ++i)
      EXPECT_EQ(triangles[i], (std::array<Index, 3>{0, i + 1, i + 2}));
  }
}

TEST(Triangulate, TakesSecondsForTheLargestPolygons) {
  expect_covered(comb(3300), "large comb");
  expect_covered(spiral(9900), "large spiral");
  EXPECT_EQ(triangulate(comb(100000)).size(), 300000U);  // so large that a fan is used
}

}  // namespace
}  // namespace relievo::io
