#include "core/angle.h"
#include "relievo/scan/surface.h"
#include "scan/measured_cloud.h"
#include "scan/turning/turned_surface.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

constexpr double noise = .01;  // standard deviation of the distances from the plane

// Adds points of a square of side 2 * half around the origin. The square is perpendicular to `normal`, and
// the noise is along the normal.
void add_plane(Cloud& cloud, std::size_t points, const Vec3& normal, double half) {
  test::Random random(11);
  const Vec3 n = normal.normalized(), side = Vec3::UnitY().cross(n).normalized(), across = n.cross(side);
  for (std::size_t i = 0; i < points; ++i) {
    const double x = random.uniform(-half, half), y = random.uniform(-half, half);
    test::add(cloud, x * side + y * across + noise * random.gaussian() * n, n);
  }
}

// Returns a sphere of radius 1 and a square of side 4, which touch at the origin. The square is
// perpendicular to `normal`.
Cloud sphere_before(const Vec3& normal) {
  Cloud cloud = test::moved(test::sphere(20000, 1), normal.normalized());
  add_plane(cloud, 20000, normal, 2);
  return cloud;
}

Vec3 tilted(double deg) {
  return {0, std::sin(to_radians(deg)), std::cos(to_radians(deg))};
}

Surface surface_of(const Cloud& cloud, bool has_plane = true) {
  View view{.has_plane = has_plane, .denoise = 0};
  return find_surface(cloud, view).value();
}

// Returns the fraction of the visible points that are on the plane. The sphere hides some points of the
// plane. All other points of the plane are visible.
double visible_share(const Cloud& cloud, const Vec3& centre) {
  std::size_t plane = 0, sphere = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i < 20000) {
      sphere += cloud.normals[i].z() > 0;
      continue;
    }
    const Vec3 to = cloud.points[i] - centre;
    plane += to.head<2>().norm() > 1 || to.z() > 0;
  }
  return static_cast<double>(plane) / static_cast<double>(plane + sphere);
}

TEST(SupportPlane, IsTheTableThatASphereLiesOn) {
  for (const double tilt : {35., 60., 75.}) {
    const Vec3 normal = tilted(tilt);
    const Cloud cloud = sphere_before(normal);
    const Surface surface = surface_of(cloud);
    ASSERT_TRUE(surface.plane) << tilt;
    const SupportPlane& plane = *surface.plane;
    EXPECT_EQ(plane.kind, PlaneKind::table);
    EXPECT_LT(to_degrees(std::acos(std::min(1., plane.normal.dot(normal)))), .2) << tilt;
    EXPECT_NEAR(plane.offset + plane.normal.dot(surface.centre), 0, noise / 2) << tilt;
    EXPECT_NEAR(plane.share, visible_share(cloud, normal), .03) << tilt;
  }
}

TEST(SupportPlane, IsTheWallBehindASphere) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(.4, 0, 1), Vec3(0, -.4, 1), Vec3(0, .2, 1)}) {
    const Surface surface = surface_of(sphere_before(normal));
    ASSERT_TRUE(surface.plane) << normal.transpose();
    EXPECT_EQ(surface.plane->kind, PlaneKind::background);
    EXPECT_LT(to_degrees(std::acos(std::min(1., surface.plane->normal.dot(normal.normalized())))), .2);
  }
}

TEST(SupportPlane, IsLeftOutUnlessTheViewHasIt) {
  const Vec3 normal = tilted(50);
  const Cloud cloud = sphere_before(normal);
  const Surface with = surface_of(cloud), without = surface_of(cloud, false);
  EXPECT_EQ(with.plane->share, without.plane->share);
  EXPECT_NEAR(static_cast<double>(without.visible_points),
              static_cast<double>(with.visible_points) * (1 - with.plane->share),
              .03 * static_cast<double>(with.visible_points));
  const Vec3 centre = normal - without.centre;
  Box box;
  for (const Vec3& p : without.points) {
    box.extend(p);
    EXPECT_NEAR((p - centre).norm(), 1, .06);  // points of outlines lie between points of the scan
  }
  EXPECT_NEAR(box.size().x(), 2, 2 * without.rho);
}

// The ridge beside the sphere has other normals than the plane, but is too low to be a figure. So it must
// be left out with the plane.
TEST(SupportPlane, IsLeftOutWithItsRidges) {
  const Vec3 normal = tilted(50), up = normal.cross(Vec3::UnitX());
  Cloud cloud = sphere_before(normal);
  test::Random random(5);
  for (int i = 0; i < 3000; ++i) {
    const double across = random.uniform(-.1, .1), height = .08 - .8 * std::abs(across);
    const Vec3 slope = (normal + (across > 0 ? .8 : -.8) * Vec3::UnitX()).normalized();
    test::add(cloud, (1.6 + across) * Vec3::UnitX() + random.uniform(-1, 1) * up + height * normal, slope);
  }
  const Surface without = surface_of(cloud, false);
  const Vec3 centre = normal - without.centre;
  for (const Vec3& p : without.points) EXPECT_NEAR((p - centre).norm(), 1, .06);
}

// A small ball lies beside the sphere. If the table is kept, the ball is kept, too. If the table is left
// out, the ball must be left out as debris, unless it has enough points compared with the largest piece.
TEST(SupportPlane, IsLeftOutWithDebris) {
  const Vec3 normal = tilted(50), place = 1.7 * Vec3::UnitX() + .5 * normal;
  for (const std::size_t points : {500, 4000}) {
    Cloud cloud = sphere_before(normal);
    for (const Vec3& p : test::sphere(points, .1).points) test::add(cloud, place + p, p.normalized());
    const auto is_seen = [&](const Surface& surface) {
      return std::ranges::any_of(surface.points,
                                 [&](const Vec3& p) { return (p + surface.centre - place).norm() < .11; });
    };
    EXPECT_TRUE(is_seen(surface_of(cloud))) << points;
    EXPECT_EQ(is_seen(surface_of(cloud, false)), points == 4000) << points;
  }
}

TEST(SupportPlane, LeavesThePointsOfTheFigureThatStandOnIt) {
  SupportPlane plane{PlaneKind::table, Vec3::UnitY(), 0, .1, .5};
  EXPECT_TRUE(plane.takes({0, .05, 0}, Vec3f(0, 1, 0)));
  EXPECT_FALSE(plane.takes({0, .05, 0}, Vec3f(0, 0, 1)));
  EXPECT_FALSE(plane.takes({0, .2, 0}, Vec3f(0, 1, 0)));
  EXPECT_TRUE(plane.takes({0, -.2, 0}, Vec3f(0, 0, 1)));
}

// Returns a rotated cube of side 2.
Cloud cube(const Eigen::AngleAxisd& turn) {
  Cloud cloud = test::cube(40000, 3);
  for (Vec3& p : cloud.points) p = turn * p;
  for (Vec3f& n : cloud.normals) n = turn.cast<float>() * n;
  return cloud;
}

TEST(SupportPlane, IsNoFaceOfASolid) {
  for (const double deg : {0., 10., 25., 40., 54.7})
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}) {
      const Eigen::AngleAxisd turn(to_radians(deg), axis.normalized());
      EXPECT_FALSE(surface_of(cube(turn)).plane) << deg << ' ' << axis.transpose();
    }
  EXPECT_FALSE(surface_of(test::sphere(20000, 1)).plane);
  EXPECT_FALSE(surface_of(test::button(40000, 1, .15)).plane);
  EXPECT_FALSE(surface_of(test::torus(20000, 2, .5)).plane);
}

// The ground of a plaque must not count as a support plane. The square on it rises by 1/50 of the plaque's
// width, as letters do, or by 1/20, as a relief does.
TEST(SupportPlane, IsNoPlaquesGround) {
  EXPECT_FALSE(surface_of(test::sheet(20000, 1, 0, 5)).plane);
  for (const double half : {.1, .3, .7})
    for (const double rise : {.04, .1}) {
      if (rise > .3 * half) continue;
      const Cloud plaque =
          test::joined(test::sheet(40000, 1, 0, 5),
                       test::sheet(static_cast<std::size_t>(4e4 * half * half), half, rise, 6));
      EXPECT_FALSE(surface_of(plaque).plane) << half << ' ' << rise;
    }
  Cloud rough;
  add_plane(rough, 20000, Vec3(0, 0, 1), 1);
  EXPECT_FALSE(surface_of(rough).plane);
}

TEST(SupportPlane, DependsOnNeitherThreadsNorOrderNorScale) {
  const Cloud cloud = sphere_before(tilted(40));
  const SupportPlane plane = *surface_of(cloud).plane;
  const auto parts = [](const SupportPlane& it) {
    return std::tuple(it.normal, it.offset, it.share, it.tolerance);
  };
  test::expect_same_for_any_threads([&] { return parts(*surface_of(cloud).plane); });
  EXPECT_EQ(parts(*surface_of(test::reversed(cloud)).plane), parts(plane));
  const SupportPlane scaled = *surface_of(test::scaled(cloud, 1024)).plane;
  EXPECT_EQ(scaled.share, plane.share);
  EXPECT_NEAR(scaled.tolerance, 1024 * plane.tolerance, 1e-6 * scaled.tolerance);
}

TEST(SupportPlane, StaysLeftOutWhileTheModelIsTurned) {
  const Vec3 normal = tilted(50);
  const Cloud cloud = sphere_before(normal);
  const Surface surface = surface_of(cloud, false);
  const TurningScan scan(*MeasuredCloud::measure(cloud, surface.view).value());
  View turned = parse_view("0.4,0.3,1").value();
  turned.has_plane = false;
  const Surface rest = turned_surface(scan.without_plane(surface), turned, 5000).value().surface;
  const Vec3 centre = turned.R_view_model * (normal - scan.centre);
  for (const Vec3& p : rest.points)
    if ((p - centre).head<2>().norm() < .9) EXPECT_NEAR((p - centre).norm(), 1, .03);
  EXPECT_NEAR(Box::of(rest.points).size().x(), 2, .1);
}

}  // namespace
}  // namespace relievo
