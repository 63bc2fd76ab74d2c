#include "relievo/scan/visible.h"

#include <gtest/gtest.h>

#include "relievo/scan/view.h"
#include "scan/depth_buffer.h"
#include "support/shapes.h"

namespace relievo {
namespace {

std::vector<Index> visible(const Cloud& cloud) {
  return visible_points(cloud, measure_spacing(cloud));
}

// Returns the fraction of the points with indices in [first, last) that are in `found`.
double share(const std::vector<Index>& found, std::size_t first, std::size_t last) {
  const auto begin = std::lower_bound(found.begin(), found.end(), first);
  const auto end = std::lower_bound(found.begin(), found.end(), last);
  return static_cast<double>(end - begin) / static_cast<double>(last - first);
}

TEST(Visible, OfTwoSheetsTheFrontOneHidesTheOther) {
  const std::size_t n = 150000;
  for (const double distance : {.05, .3, 5.0}) {
    const Cloud both = test::joined(test::sheet(n, 1, 0, 11), test::sheet(n, 1, distance, 12));
    const std::vector<Index> found = visible(both);
    EXPECT_LT(share(found, 0, n), 1e-5) << "hidden sheet, at distance " << distance;
    EXPECT_GT(share(found, n, 2 * n), .999) << "front sheet, at distance " << distance;
  }
}

TEST(Visible, OfASphereAlmostAllThatFacesTheViewer) {
  const Cloud sphere = test::sphere(200000, 1);
  const std::vector<Index> found = visible(sphere);
  std::size_t facing = 0, facing_found = 0, behind_found = 0;
  for (const Vec3f& n : sphere.normals) facing += n.z() > .15F;
  for (const Index i : found) {
    facing_found += sphere.normals[i].z() > .15F;
    behind_found += sphere.normals[i].z() < 0;
  }
  EXPECT_GE(static_cast<double>(facing_found), .995 * static_cast<double>(facing));
  EXPECT_EQ(behind_found, 0U);
}

// In the right half of the front sheet, the points are a tenth as dense. Still, this half must hide the
// sheet behind it.
TEST(Visible, UnevenDensityLeavesNoHoles) {
  test::Random random(22);
  const Cloud uneven = test::where(test::sheet(60000, 1, .5, 21),
                                   [&](const Vec3& p) { return p.x() < 0 || random.uniform() < .1; });
  const std::size_t n = 60000;
  const std::vector<Index> found = visible(test::joined(test::sheet(n, .98, 0, 23), uneven));
  EXPECT_LT(share(found, 0, n), 1e-4);
  EXPECT_GT(share(found, n, n + uneven.size()), .999);
}

TEST(Visible, StraysNeitherShowNorHide) {
  const std::size_t n = 20000;
  Cloud cloud = test::sheet(n, 1, 0);
  for (int i = 0; i < 5; ++i) test::add(cloud, Vec3(.1 * i, .001 * i, 1), Vec3::UnitZ());
  const std::vector<Index> found = visible(cloud);
  EXPECT_GT(share(found, 0, n), .999);
  EXPECT_EQ(share(found, n, n + 5), 0);
}

TEST(Visible, OfTwinsInTheViewPlaneTheNearerStays) {
  Cloud cloud = test::sheet(5000, 1, 0);
  const double rho = measure_spacing(cloud).rho;
  const std::size_t n = cloud.size();
  for (std::size_t i = 0; i < 100; ++i)
    test::add(cloud, cloud.points[i] + Vec3(0, 0, .1 * rho), Vec3::UnitZ());
  const std::vector<Index> found = visible(cloud);
  EXPECT_EQ(share(found, n, n + 100), 1);
  EXPECT_EQ(share(found, 0, 100), 0);
}

TEST(Visible, SpecksAreRemovedAndCounted) {
  Cloud cloud = test::sheet(20000, 1, 0);
  const std::size_t n = cloud.size();
  for (int speck = 0; speck < 7; ++speck)
    for (int k = 0; k < 5; ++k) test::add(cloud, {.2 * speck - .6, .001 * k, 1}, Vec3::UnitZ());
  const VisiblePoints found = find_visible(cloud, measure_spacing(cloud));
  EXPECT_NEAR(static_cast<double>(found.removed), 35, 2);  // some points of the sheet may be removed, too
  EXPECT_EQ(share(found.points, n, cloud.size()), 0);
  EXPECT_GT(share(found.points, 0, n), .999);
}

// In one part of a mesh, the distances between points may be forty times as large as in another part.
TEST(Visible, OfVeryUnevenDensityAlmostAllToo) {
  const std::size_t dense = 50000, sparse = 3000;
  const Cloud both = test::joined(test::sheet(dense, .1, 0, 11), test::sheet(sparse, 1, 0, 12));
  const VisiblePoints found = find_visible(both, measure_spacing(both));
  EXPECT_EQ(found.removed, 0U);
  EXPECT_GT(share(found.points, 0, dense),
            .97);  // less than 1: points that coincide within a fraction of rho count once
  EXPECT_GT(share(found.points, dense, dense + sparse), .99);
}

TEST(Visible, IsTheSameForAnyOrder) {
  const Cloud cloud = test::torus(20000, 1, .4);
  const std::vector<Index> found = visible(cloud);
  std::vector<Index> reversed = visible(test::reversed(cloud));
  for (Index& i : reversed) i = static_cast<Index>(cloud.size()) - 1 - i;
  std::sort(reversed.begin(), reversed.end());
  EXPECT_EQ(found, reversed);
}

// The ledge lies at the edge of the depth image. Its narrow end is one pixel wide, and the points there have
// no near neighbours. Such points hide many others, unless the cloud is marked as a height field.
TEST(Visible, OfAHeightFieldIsAll) {
  Cloud steps;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) test::add(steps, Vec3(x, y, 4 * x < y - 20 ? 30 : 0), Vec3::UnitZ());
  EXPECT_LT(visible(steps).size(), steps.size() - 20);
  steps.is_height_field = true;
  EXPECT_EQ(visible(steps).size(), steps.size());
  const Cloud turned = in_view(steps, *parse_view("1,0,3"));
  EXPECT_FALSE(turned.is_height_field);
}

// The front of a box has a hole, through which the inner side of the back is visible. The normals there face
// away from the viewer. Still, the points must fill the hole.
TEST(HoleFillPoints, StandInWhereOnlyTheOtherSideWasScanned) {
  const Cloud front =
      test::where(test::sheet(40000, 1, 0), [](const Vec3& p) { return p.head<2>().norm() > .2; });
  const Cloud box = test::joined(front, test::inside_out(test::sheet(40000, 1, -.5, 15)));
  const Spacing spacing = measure_spacing(box);
  const std::vector<Index> seen = visible_points(box, spacing);
  const std::vector<Index> hole_fill = hole_fill_points(box, spacing, seen);
  EXPECT_EQ(share(seen, front.size(), box.size()), 0);
  const double squares = 3.14 * .2 * .2 / (spacing.rho * spacing.rho);
  EXPECT_GT(static_cast<double>(hole_fill.size()), .3 * squares);
  EXPECT_LT(static_cast<double>(hole_fill.size()), 1.2 * squares);
  for (const Index i : hole_fill) {
    EXPECT_GE(i, front.size());
    EXPECT_LT(box.points[i].head<2>().norm(), .2 - spacing.rho);
  }
}

TEST(HoleFillPoints, AreNotNeededOnAClosedModel) {
  const Cloud torus = test::torus(30000, 1, .4);
  const Spacing spacing = measure_spacing(torus);
  EXPECT_TRUE(hole_fill_points(torus, spacing, visible_points(torus, spacing)).empty());
}

TEST(Visible, OfNothingIsNothing) {
  const Cloud no_normals{test::sheet(1000, 1, 0).points, {}};
  EXPECT_TRUE(visible(no_normals).empty());
  EXPECT_TRUE(hole_fill_points(no_normals, measure_spacing(no_normals), std::vector<Index>{0}).empty());
  EXPECT_TRUE(visible({}).empty());
  EXPECT_TRUE(visible(test::inside_out(test::sheet(1000, 1, 0))).empty());
  EXPECT_TRUE(visible({std::vector<Vec3>(10, Vec3::Zero()), std::vector<Vec3f>(10, Vec3f::UnitZ())}).empty());
}

// After discs are removed from a buffer, it must equal the buffer of the other discs alone.
TEST(DepthBuffer, ForgetsDiscsThatAreTakenAway) {
  const Cloud sphere = test::sphere(4'000, 1);
  std::vector<Disc> all, gone, rest;
  for (std::size_t i = 0; i < sphere.size(); ++i) {
    all.push_back({sphere.points[i], sphere.normals[i], .05});
    (i % 400 == 0 ? gone : rest).push_back(all.back());
  }
  const Box box = bounds(sphere);
  DepthBuffer changed(box, .01), expected(box, .01);
  changed.splat(all);
  changed.take_away(gone, rest);
  expected.splat(rest);
  std::size_t redrawn = 0;
  for (double x = -.995; x < 1; x += .01)
    for (double y = -.995; y < 1; y += .01) {
      ASSERT_EQ(changed.depth(x, y), expected.depth(x, y)) << x << " " << y;
      redrawn += changed.is_redrawn(x, y);
    }
  EXPECT_GT(redrawn, 500U);
  EXPECT_LT(redrawn, 20'000U);
}

}  // namespace
}  // namespace relievo
