#include "scan/outlines/outlines.h"

#include "scan/outlines/outline_points.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

using test::surface_of;

// Returns a button of radius 1.15, and in front of it a button of half that size.
Cloud two_buttons(std::size_t n) {
  return test::joined(test::button(n, 1, .15), test::button(n / 4, .5, .075, .6));
}

// Returns the distances of points from the model's z axis, for those points i of the surface for which
// holds(i) is true.
template <typename Condition>
std::vector<double> radii(const Surface& surface, Condition holds) {
  std::vector<double> found;
  for (Index i = 0; i < surface.points.size(); ++i)
    if (holds(i)) found.push_back((surface.points[i] + surface.centre).head<2>().norm());
  return found;
}

struct Spread {
  double mean = 0, deviation = 0, farthest = 0;  // of differences from a given radius, in rho
};

Spread spread(const std::vector<double>& radii, double radius, double rho) {
  Spread s;
  const auto n = static_cast<double>(radii.size());
  for (const double r : radii)
    s.mean += (r - radius) / rho / n, s.farthest = std::max(s.farthest, std::abs(r - radius) / rho);
  for (const double r : radii) s.deviation += std::pow((r - radius) / rho - s.mean, 2) / n;
  s.deviation = std::sqrt(s.deviation);
  return s;
}

class OutlinesOfButtons : public testing::TestWithParam<std::size_t> {};

TEST_P(OutlinesOfButtons, SilhouetteIsTheTrueCircle) {
  const Surface surface = surface_of(two_buttons(GetParam()));
  const std::vector<double> found =
      radii(surface, [&](Index i) { return surface.boundary.is_boundary[i] != 0; });
  const Spread s = spread(found, 1.15, surface.rho);
  EXPECT_NEAR(static_cast<double>(found.size()), 2 * std::numbers::pi * 1.15 / (.75 * surface.rho), 5);
  EXPECT_LT(s.farthest, .05);
  EXPECT_LT(s.deviation, .02);
}

TEST_P(OutlinesOfButtons, WallAtTheJumpIsAnEvenStrip) {
  const Surface surface = surface_of(two_buttons(GetParam()));
  const auto on = [&](WallSide side) {
    return spread(radii(surface, [&](Index i) { return surface.boundary.wall_side[i] == side; }), .575,
                  surface.rho);
  };
  const Spread front = on(WallSide::front), back = on(WallSide::back);
  EXPECT_NEAR(front.mean, -.15, .02);
  EXPECT_NEAR(back.mean, .15, .02);
  EXPECT_LT(front.deviation, .02);
  EXPECT_LT(back.deviation, .02);
}

TEST_P(OutlinesOfButtons, PointsOfRowsHaveTheNormalsAndDepthsOfTheirSide) {
  const Surface surface = surface_of(two_buttons(GetParam()));
  const double rho = surface.rho;
  for (Index i = 0; i < surface.points.size(); ++i) {
    if (surface.boundary.wall_side[i] == WallSide::none) continue;
    const Vec3 p = surface.points[i] + surface.centre;
    const bool is_front = surface.boundary.wall_side[i] == WallSide::front;
    const double lean = is_front ? (p.head<2>().norm() - .5) / .075 : 0;
    EXPECT_NEAR(static_cast<double>(surface.normals[i].head<2>().norm()), lean, 15 * rho);
    EXPECT_NEAR(p.z(), is_front ? .6 + .075 * std::sqrt(1 - lean * lean) : .15, .75 * rho);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, OutlinesOfButtons, testing::Values(20000, 200000));

TEST(Outlines, OfANoisyScanStayNear) {
  const Cloud clean = two_buttons(100000);
  const Surface surface = surface_of(test::noisy(clean, .15 * surface_of(clean).rho, 0));
  const Spread s = spread(radii(surface, [&](Index i) { return surface.boundary.is_boundary[i] != 0; }), 1.15,
                          surface.rho);
  EXPECT_LT(s.farthest, .6);
  EXPECT_LT(s.deviation, .1);
}

// Returns the longest edge of all triangles inside the outline, measured in the view plane, in rho.
double longest_side(const Surface& surface) {
  double longest = 0;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t) {
    const Triangle& c = surface.triangulation.triangles[t];
    for (std::size_t i = 0; i < 3 && surface.boundary.is_inside[t]; ++i)
      longest = std::max(longest, (surface.points[c[i]] - surface.points[c[(i + 1) % 3]]).head<2>().norm());
  }
  return longest / surface.rho;
}

// Returns points of a square on a regular grid, each displaced by up to a third of the spacing.
Cloud jittered_square(int per_side, double half) {
  test::Random random(17);
  Cloud cloud;
  const double step = 2 * half / per_side;
  for (int i = 0; i < per_side * per_side; ++i) {
    const double x = i % per_side + .5 + random.uniform(-.33, .33),
                 y = i / per_side + .5 + random.uniform(-.33, .33);
    test::add(cloud, {x * step - half, y * step - half, 0}, Vec3::UnitZ());
  }
  return cloud;
}

TEST(Outlines, KeepTheCornersOfASheet) {
  const Surface surface = surface_of(jittered_square(200, 1));
  for (const double x : {-1., 1.})
    for (const double y : {-1., 1.}) {
      double nearest = 1;
      for (Index i = 0; i < surface.points.size(); ++i)
        if (surface.boundary.is_boundary[i])
          nearest = std::min(nearest, ((surface.points[i] + surface.centre).head<2>() - Vec2(x, y)).norm());
      EXPECT_LT(nearest, surface.rho);
    }
}

TEST(Outlines, OfASphereHaveNoJump) {
  const Surface surface = surface_of(test::sphere(40000, 1));
  for (const WallSide side : surface.boundary.wall_side) EXPECT_EQ(side, WallSide::none);
}

TEST(Outlines, LeaveNoGapInside) {
  const Cloud cloud = test::button(60000, 1, .15);
  const double rho = surface_of(cloud).rho;
  // The hole is so narrow that it must be closed.
  const auto is_beside = [&](const Vec3& p) { return (p.head<2>() - Vec2(.3, .2)).norm() > 4.5 * rho; };
  EXPECT_LT(longest_side(surface_of(test::where(cloud, is_beside))), 3.5);
}

TEST(Outlines, OfASliverHaveNoGap) {
  // A second sheet covers the first sheet except for a narrow strip, in which there is at most one row of points.
  for (const double width : {.3, .6, 1.}) {
    Cloud cloud = jittered_square(200, 1);
    const double rho = surface_of(cloud).rho;
    const Cloud front = jittered_square(200, 1);
    for (const Vec3& p : front.points)
      if (p.x() < 1 - width * rho && std::abs(p.y()) < .7)
        test::add(cloud, p + Vec3(0, 0, .3), Vec3::UnitZ());
    EXPECT_LT(longest_side(surface_of(cloud)), 4) << width;
  }
}

// Returns the width of the bounding box of the triangles inside the boundary.
double width_of(const Surface& surface) {
  Box box;
  for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
    if (surface.boundary.is_inside[t])
      for (const Index i : surface.triangulation.triangles[t]) box.extend(surface.points[i]);
  return box.size().x();
}

// The cloud has, from left to right, a sphere, a larger button, and a smaller sphere. None of them is so
// small that it would be left out as a crumb.
TEST(Outlines, LeaveOutAllButTheLargestPieces) {
  const Cloud button = test::button(40000, 1, .15);
  const Cloud cloud = test::joined(test::joined(button, test::moved(test::sphere(6000, .4), {-1.8, 0, 0})),
                                   test::moved(test::sphere(3000, .3), {1.6, 0, 0}));
  const double rho = surface_of(button).rho;
  View view;
  EXPECT_NEAR(width_of(surface_of(cloud)), 2.2 + 1.9, 2 * rho);
  for (const auto& [most, expected] : {std::pair(1, 2.3), {2, 2.2 + 1.15}, {3, 2.2 + 1.9}, {9, 2.2 + 1.9}}) {
    view.most_pieces = most;
    const Surface surface = surface_of(cloud, view);
    EXPECT_NEAR(width_of(surface), expected, 2 * rho) << most;
    EXPECT_EQ(surface.crumbs, most < 3 ? 3U - static_cast<unsigned>(most) : 0U);
  }
}

TEST(Outlines, LeaveOutCrumbsUnlessTheViewHasThem) {
  const Cloud button = test::button(40000, 1, .15);
  const double rho = surface_of(button).rho;
  const Cloud crumb = test::sphere(200, .03);  // has 0.07 % of the button's area, and at least 13 rho^2
  const Cloud cloud = test::joined(button, test::moved(crumb, {1.6, 0, 0}));
  View view{.has_crumbs = true};
  const Surface without = surface_of(cloud), with = surface_of(cloud, view);
  EXPECT_EQ(without.crumbs, 1U);
  EXPECT_EQ(with.crumbs, 0U);
  EXPECT_NEAR(width_of(without), 2.3, rho);
  EXPECT_NEAR(width_of(with), 1.15 + 1.63, rho);
}

TEST(Outlines, OfACroppedScanAreItsCut) {
  View view{.crop = {{0, 0}, {.5, 1}}};
  const Surface surface = surface_of(test::button(40000, 1, .15), view);
  EXPECT_NEAR(Box::of(surface.points).size().x(), 1.15, surface.rho);
  EXPECT_NEAR(Box::of(surface.points).size().y(), 2.3, surface.rho);
  view.crop = {{.9, .9}, {.91, .91}};
  EXPECT_EQ(find_surface(test::button(40000, 1, .15), view).error().input, "crop");
}

}  // namespace
}  // namespace relievo
