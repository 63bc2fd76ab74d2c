#include <random>

#include "scan/measured_cloud.h"
#include "scan/turning/turned_surface.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

TurnedSurface turned(const Cloud& cloud, const View& view = {}) {
  return turned_surface(TurningScan(*MeasuredCloud::measure(cloud, {}).value()), view, 5'000).value();
}

TEST(TurnedSurface, LiesOnTheSphere) {
  const TurnedSurface sphere = turned(test::sphere(60'000, 1), parse_view("1,1,1").value());
  ASSERT_GT(sphere.surface.points.size(), 3'000U);
  for (std::size_t i = 0; i < sphere.surface.points.size(); ++i) {
    const Vec3& p = sphere.surface.points[i];
    if (p.head<2>().norm() > .9) continue;  // nearly edge on; there the depth within a cell varies much
    EXPECT_NEAR(p.norm(), 1, .02);
    EXPECT_GT(sphere.surface.normals[i].cast<double>().dot(p.normalized()), .998);
  }
}

// Two spheres of different colours and heights, one of which hides a part of the other.
TEST(TurnedSurface, HasTheColoursAndOwnHeightsOfThePointsInFront) {
  Cloud cloud = test::joined(test::sphere(60'000, 1), test::moved(test::sphere(60'000, .5), {0, 0, 2}));
  for (const Vec3& p : cloud.points) {
    const bool is_small = p.z() > 1.2;
    cloud.colours.push_back(is_small ? Colour{200, 0, 0} : Colour{0, 0, 100});
    cloud.own_heights.push_back(is_small ? .5F : 0.F);
  }
  const Surface surface = turned(cloud).surface;
  ASSERT_EQ(surface.colours.size(), surface.points.size());
  ASSERT_EQ(surface.own_heights.size(), surface.points.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double distance = surface.points[i].head<2>().norm();
    if (std::abs(distance - .5) < .04 || distance > .97) continue;  // next to outlines
    const bool is_small = distance < .5;
    EXPECT_EQ(surface.colours[i], (is_small ? Colour{200, 0, 0} : Colour{0, 0, 100})) << distance;
    EXPECT_EQ(surface.own_heights[i], is_small ? .5F : 0.F) << distance;
  }
  EXPECT_TRUE(turned(test::sphere(60'000, 1)).surface.colours.empty());
}

// The smaller sheet hides only a part of the larger sheet behind it. So the covered area is the area of the
// larger sheet.
TEST(FrontCells, ShowsWhatIsInFront) {
  const TurnedSurface sheets =
      turned(test::joined(test::sheet(40'000, 1, 0, 5), test::sheet(20'000, .5, .7, 6)));
  const FrontCells& front = sheets.front;
  double area = 0;
  for (int y = 0; y < front.depth.height; ++y)
    for (int x = 0; x < front.depth.width; ++x) {
      if (!front.is_covered(x, y)) continue;
      area += static_cast<double>(front.cell * front.cell);
      const Vec2f place = front.centre(x, y).cwiseAbs();
      const float reach = place.maxCoeff();
      if (std::abs(reach - .5F) < .05F) continue;  // next to the depth jump
      EXPECT_NEAR(front.depth.at(x, y), reach < .5F ? .35F : -.35F, 1e-4F);
    }
  EXPECT_NEAR(area, 4, .15);
}

TEST(FrontCells, HasTheSameBitsWithAndWithoutWideVectors) {
  const Cloud cloud = test::torus(30'000, 1, .4);
  test::expect_same_without_avx2([&] {
    const FrontCells front = turned(cloud, parse_view("1,2,3").value()).front;
    return std::pair(front.depth.pixels, front.normal.pixels);
  });
}

TEST(FrontCells, MarksTheEdgesOfAJump) {
  const TurnedSurface sheets =
      turned(test::joined(test::sheet(40'000, 1, 0, 5), test::sheet(20'000, .5, .7, 6)));
  const FrontCells& front = sheets.front;
  std::size_t edges = 0;
  for (int y = 0; y < front.depth.height; ++y)
    for (int x = 0; x < front.depth.width; ++x) {
      if (!front.is_edge.at(x, y)) continue;
      const double reach = static_cast<double>(front.centre(x, y).cwiseAbs().maxCoeff());
      EXPECT_TRUE(std::abs(reach - .5) < .05 || std::abs(reach - 1) < .05) << reach;
      ++edges;
    }
  EXPECT_GT(edges, static_cast<std::size_t>(4 / front.cell));
}

// Returns random cells at depth 0, about half of them covered.
FrontCells random_front(unsigned seed) {
  constexpr int width = 50, height = 40;
  FrontCells front{.depth = filled_image(width, height, 0.F),
                   .normal = filled_image<Vec3f>(width, height, Vec3f::Zero())};
  std::mt19937 random(seed);
  for (Vec3f& normal : front.normal.pixels)
    if (random() % 2 == 0) normal = Vec3f::UnitZ(), ++front.covered;
  return front;
}

// Returns, for each cell, the size of its component. A component is a connected set of cells that are all
// covered or all uncovered. It is found by walking from cell to cell.
std::vector<std::size_t> sizes_of_pieces(const FrontCells& front) {
  const Image<Vec3f>& normal = front.normal;
  std::vector<std::size_t> sizes;
  for (std::size_t start = 0; start < normal.size(); ++start) {
    std::vector<bool> is_seen(normal.size());
    std::vector<std::size_t> piece{start};
    is_seen[start] = true;
    for (std::size_t next = 0; next < piece.size(); ++next) {
      const int x = static_cast<int>(piece[next]) % normal.width,
                y = static_cast<int>(piece[next]) / normal.width;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (!normal.contains(x + dx, y + dy)) continue;
        const std::size_t other = normal.index(x + dx, y + dy);
        if (is_seen[other] || normal[other] != normal[start]) continue;
        is_seen[other] = true;
        piece.push_back(other);
      }
    }
    sizes.push_back(piece.size());
  }
  return sizes;
}

// Expects that exactly the cells for which is_covered() returns true are covered, and that `covered` is the
// number of these cells.
template <typename F>
void expect_covered(const FrontCells& front, F&& is_covered) {
  std::size_t covered = 0;
  for (std::size_t i = 0; i < front.normal.size(); ++i) {
    EXPECT_EQ(front.normal[i].z() > 0, is_covered(i)) << i;
    EXPECT_EQ(front.depth[i], 0) << i;
    covered += front.normal[i].z() > 0;
  }
  EXPECT_EQ(front.covered, covered);
}

TEST(FrontCells, LoseSmallPieces) {
  const FrontCells before = random_front(1);
  const std::vector<std::size_t> sizes = sizes_of_pieces(before);
  FrontCells after = before;
  clear_small_pieces(after, 6, 0);
  expect_covered(after, [&](std::size_t i) { return before.normal[i].z() > 0 && sizes[i] >= 6; });
  EXPECT_LT(after.covered, before.covered);
}

TEST(FrontCells, KeepOnlyTheLargestPiece) {
  const FrontCells before = random_front(1);
  const std::vector<std::size_t> sizes = sizes_of_pieces(before);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (before.normal[i].z() > 0) largest = std::max(largest, sizes[i]);
  FrontCells after = before;
  clear_small_pieces(after, 6, 1);
  expect_covered(after, [&](std::size_t i) { return before.normal[i].z() > 0 && sizes[i] == largest; });
}

TEST(FrontCells, CloseSmallHoles) {
  const FrontCells before = random_front(2);
  const std::vector<std::size_t> sizes = sizes_of_pieces(before);
  FrontCells after = before;
  fill_small_holes(after, 6);
  expect_covered(after, [&](std::size_t i) { return before.normal[i].z() > 0 || sizes[i] <= 6; });
  EXPECT_GT(after.covered, before.covered);
}

}  // namespace
}  // namespace relievo
