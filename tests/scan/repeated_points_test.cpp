#include "scan/merging/repeated_points.h"

#include <limits>

#include "support/surfaces.h"

namespace relievo {
namespace {

using test::surface_of;

constexpr double size = 2.8;  // width of the torus
const Cloud& single() {
  static const Cloud cloud = test::torus(20'000, 1, .4);
  return cloud;
}

// Describes the cloud that repeated() returns. Each point with y < up_to appears `copies` times in it;
// every other point appears once. All points are moved by Gaussian noise.
struct Repeats {
  std::size_t copies = 1;
  double jitter = 0;  // standard deviation of the noise, as a fraction of `size`
  double up_to = 10;
};

Cloud repeated(const Cloud& cloud, const Repeats& repeats) {
  test::Random random(7);
  std::vector<std::pair<std::uint64_t, Index>> order;
  for (Index i = 0; i < cloud.size(); ++i)
    for (std::size_t k = 0; k < (cloud.points[i].y() < repeats.up_to ? repeats.copies : 1); ++k)
      order.emplace_back(random.bits(), i);
  std::ranges::sort(order);
  Cloud all;
  const double deviation = repeats.jitter * size;
  for (const auto& [key, i] : order) {
    const Vec3 off(random.gaussian(), random.gaussian(), random.gaussian());
    test::add(all, cloud.points[i] + deviation * off, cloud.normals[i].cast<double>());
  }
  return all;
}

double farthest_from_torus(const Surface& surface) {
  double farthest = 0;
  for (const Vec3& p : surface.points)
    farthest = std::max(farthest, std::abs(std::hypot(p.head<2>().norm() - 1, p.z()) - .4));
  return farthest;
}

// Returns the largest difference between the points or normals of two surfaces; infinity if the numbers of
// points differ. If one surface was made from points in another order, the difference is not exactly 0,
// because sums over neighbours are rounded differently.
double farthest_apart(const Surface& a, const Surface& b) {
  if (a.points.size() != b.points.size()) return std::numeric_limits<double>::infinity();
  double farthest = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    farthest = std::max(
        {farthest, (a.points[i] - b.points[i]).norm(), double{(a.normals[i] - b.normals[i]).norm()}});
  return farthest;
}

TEST(RepeatedPoints, ExactOnesGiveTheSurfaceOfTheSinglePoints) {
  const Surface alone = surface_of(single());
  for (const std::size_t copies : {2U, 3U, 5U, 20U}) {
    const Surface all = surface_of(repeated(single(), {copies}));
    EXPECT_LT(farthest_apart(all, alone), 2e-6) << copies;
    EXPECT_EQ(all.repeated_points, (copies - 1) * single().size());
  }
}

TEST(RepeatedPoints, NearOnesGiveAboutTheSurfaceOfTheSinglePoints) {
  const Surface alone = surface_of(single());
  for (const std::size_t copies : {2U, 3U, 5U, 20U})
    for (const double jitter : {1e-7, 1e-6, 1e-5}) {
      const Surface all = surface_of(repeated(single(), {copies, jitter}));
      EXPECT_NEAR(all.rho / alone.rho, 1, .01) << copies << " " << jitter;
      EXPECT_NEAR(static_cast<double>(all.points.size()) / static_cast<double>(alone.points.size()), 1, .02)
          << copies << " " << jitter;
      EXPECT_LT(farthest_from_torus(all), .01);
    }
}

TEST(RepeatedPoints, OfAPartGiveTheSurfaceOfTheSinglePoints) {
  const Surface alone = surface_of(single());
  for (const double up_to : {-1.2, -.5, .5})
    for (const std::size_t copies : {5U, 20U})
      EXPECT_LT(farthest_apart(surface_of(repeated(single(), {copies, 0, up_to})), alone), 2e-6)
          << up_to << " " << copies;
}

TEST(RepeatedPoints, AreFoundWithoutNormals) {
  const Cloud bare = test::without_normals(single()),
              all = test::without_normals(repeated(single(), {5, 1e-6}));
  EXPECT_NEAR(surface_of(all).rho / surface_of(bare).rho, 1, .01);
  EXPECT_NEAR(static_cast<double>(surface_of(all).points.size()),
              static_cast<double>(surface_of(bare).points.size()), .02 * 1e4);
}

TEST(RepeatedPoints, HaveTheMeanOfTheirNormalsAndColours) {
  Cloud corners;
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x)
      for (const double lean : {-.3, 0., .3}) {
        test::add(corners, Vec3(x, y, 0), Vec3(lean, 0, 1));
        corners.colours.push_back({static_cast<std::uint8_t>(100 + 100 * lean), 0, 9});
      }
  const Cloud merged = without_repeated_points(corners);
  ASSERT_EQ(merged.size(), 100U);
  for (Index i = 0; i < 100; ++i) {
    EXPECT_LT((merged.normals[i] - Vec3f::UnitZ()).norm(), 1e-6F);
    EXPECT_EQ(merged.colours[i], (Colour{100, 0, 9}));
  }
}

TEST(RepeatedPoints, OfBothSidesOfASheetStay) {
  Cloud sheet;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 30; ++x)
      for (const double side : {1., -1., 1., -1.}) test::add(sheet, Vec3(x, y, 0), Vec3(0, 0, side));
  const Cloud merged = without_repeated_points(sheet);
  ASSERT_EQ(merged.size(), 2U * 900);
  EXPECT_EQ(std::ranges::count(merged.normals, Vec3f(Vec3f::UnitZ())), 900);
}

TEST(RepeatedPoints, AreNotSeenAmongScatteredOnes) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Cloud cloud = test::sphere(5'000, 1, seed);
    EXPECT_EQ(without_repeated_points(cloud).points, cloud.points);
  }
}

// Marching cubes create up to three vertices near a corner of the grid. These vertices must not count
// as repeated points.
TEST(RepeatedPoints, AreNotSeenInMarchingCubes) {
  test::Random random(3);
  Cloud mesh;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const double off = random.uniform(-.5, .5);  // distance of the surface from the corner of the grid
      test::add(mesh, Vec3(x, y, off), Vec3(0, 0, 1));
      if (off > 0) test::add(mesh, Vec3(x + off, y, 0), Vec3(0, 0, 1));
      if (off > 0) test::add(mesh, Vec3(x, y + off, 0), Vec3(0, 0, 1));
    }
  EXPECT_EQ(without_repeated_points(mesh).size(), mesh.size());
}

// The cloud consists of patches of 30 points, which are so far apart that they are not connected.
TEST(LostFigure, IsRefused) {
  Cloud shreds;
  for (int row = 0; row < 300; ++row)
    for (int column = 0; column < 300; ++column)
      if (row % 10 < 6 && column % 9 < 5) test::add(shreds, Vec3(column, row, 0), Vec3(0, 0, 1));
  expect_error(find_surface(shreds, {}), ErrorKind::geometry,
               "expected points that lie close together, found ");
}

Cloud subsample(const Cloud& cloud, double wanted) {
  return relievo::subsample(cloud, measure_spacing(cloud), wanted);
}

TEST(Subsample, HasAboutTheSpacingAskedFor) {
  const Cloud cloud = test::sphere(60000, 1);
  const double own = measure_spacing(cloud).rho;
  for (const double times : {1.2, 1.4, 2.0, 4.0})
    EXPECT_NEAR(measure_spacing(subsample(cloud, times * own)).rho, times * own, .08 * times * own) << times;
}

TEST(Subsample, KeepsPointsOfTheCloudAndNoTwoClose) {
  const Cloud cloud = test::torus(20000, 1, .4);
  const Cloud thin = subsample(cloud, .1);
  for (std::size_t i = 0; i < thin.size(); ++i) {
    EXPECT_NE(std::ranges::find(cloud.points, thin.points[i]), cloud.points.end());
    for (std::size_t j = 0; j < i; ++j) ASSERT_GT((thin.points[i] - thin.points[j]).norm(), .05);
  }
}

TEST(Subsample, AveragesNormalsAndColours) {
  Cloud cloud = test::noisy(test::sheet(100000, 1, 0), 0, .2);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.colours.push_back({static_cast<std::uint8_t>(i % 2 ? 200 : 100), 7, 7});
  const Cloud thin = subsample(cloud, .1);
  ASSERT_GT(thin.size(), 100U);
  for (std::size_t i = 0; i < thin.size(); ++i) {
    EXPECT_GT(thin.normals[i].z(), .99F);
    EXPECT_NEAR(thin.colours[i][0], 150, 25);
    EXPECT_EQ(thin.colours[i][1], 7);
  }
}

TEST(Subsample, BothSidesOfAThinWallStay) {
  const Cloud wall = test::sheet(20000, 1, 0);
  const Cloud back = test::inside_out(test::sheet(20000, 1, -1e-3, 9));
  const Cloud thin = subsample(test::joined(wall, back), .1);
  const auto facing = std::ranges::count_if(thin.normals, [](const Vec3f& n) { return n.z() > .9F; });
  const auto away = std::ranges::count_if(thin.normals, [](const Vec3f& n) { return n.z() < -.9F; });
  EXPECT_EQ(static_cast<std::size_t>(facing + away), thin.size());
  EXPECT_NEAR(static_cast<double>(facing), static_cast<double>(away), .1 * static_cast<double>(facing));
}

TEST(Subsample, OfNothingIsNothing) {
  EXPECT_EQ(subsample({}, 1).size(), 0U);
}

}  // namespace
}  // namespace relievo
