#include "geometry/edges.h"

#include <gtest/gtest.h>

#include "relievo/geometry/triangulation.h"
#include "support/planar_points.h"

namespace relievo {
namespace {

// The number of edges is the number of points plus the number of triangles minus one (Euler's formula).
TEST(Edges, HaveTheSidesOfOneOrTwoTriangles) {
  const std::vector<Vec2> points = random_points(500, 3);
  const Triangulation mesh = delaunay(points);
  std::size_t edges = 0, on_hull = 0, sides_of_all = 0;
  std::pair<Index, Index> last{0, 0};
  each_edge(mesh.triangles, [&](std::span<const TriangleSide> sides) {
    const std::pair ends(sides[0].low(), sides[0].high());
    EXPECT_LT(last, ends);
    last = ends;
    ++edges, on_hull += sides.size() == 1, sides_of_all += sides.size();
    if (sides.size() > 1) {
      EXPECT_LT(sides[0].triangle, sides[1].triangle);
      EXPECT_EQ(sides[0].from, sides[1].to);
      EXPECT_EQ(sides[0].to, sides[1].from);
    }
    for (const TriangleSide& side : sides)
      EXPECT_TRUE(std::ranges::is_permutation(mesh.triangles[side.triangle],
                                              std::array{side.from, side.to, side.apex}));
  });
  EXPECT_EQ(edges, points.size() + mesh.triangles.size() - 1);
  EXPECT_EQ(on_hull, mesh.hull.size());
  EXPECT_EQ(sides_of_all, 3 * mesh.triangles.size());
}

TEST(Edges, AreThoseOfWantedSides) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 3}};
  std::vector<std::pair<Index, std::size_t>> found;
  each_edge(
      triangles, [](const TriangleSide& side) { return side.apex != 3; },
      [&](std::span<const TriangleSide> sides) { found.emplace_back(sides[0].apex, sides.size()); });
  EXPECT_EQ(found, (std::vector<std::pair<Index, std::size_t>>{{2, 1}, {1, 1}, {0, 1}, {2, 1}, {1, 1}}));
}

}  // namespace
}  // namespace relievo
