#include "scan/front_mesh.h"

#include "support/shapes.h"
#include "support/triangles.h"

namespace relievo {
namespace {

TEST(FrontMesh, CoversWhatIsSeen) {
  const Cloud ball = test::sphere(10000, 1);
  const Mesh mesh = front_mesh(ball, measure_spacing(ball));
  EXPECT_NEAR(test::area_of(mesh.points, mesh.triangles), std::numbers::pi, .02 * std::numbers::pi);
  ASSERT_EQ(mesh.corner_normals.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = mesh.points[mesh.triangles[t][i]];
      EXPECT_GT(p.z(), -.1);
      EXPECT_GT(p.normalized().dot(mesh.corner_normals[t][i].cast<double>()), .98);
    }
}

TEST(FrontMesh, LeavesNoGapAndNoWallWhereTheDepthJumps) {
  const Cloud scene = test::joined(test::sheet(16000, 1, 0), test::sheet(4000, .5, 2, 8));
  const Mesh mesh = front_mesh(scene, measure_spacing(scene));
  EXPECT_NEAR(test::area_of(mesh.points, mesh.triangles), 4, .1);
  for (const Vec3& p : mesh.points) EXPECT_LT(std::min(std::abs(p.z()), std::abs(p.z() - 2)), 1e-9);
  // Only triangles at the edge of the nearer sheet may have corners on both sheets.
  const double rho = measure_spacing(scene).rho;
  for (const Triangle& t : mesh.triangles) {
    const auto is_near = [&](Index i) { return mesh.points[i].z() > 1; };
    if (is_near(t[0]) == is_near(t[1]) && is_near(t[0]) == is_near(t[2])) continue;
    const Vec2 middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]).head<2>() / 3;
    EXPECT_NEAR(middle.cwiseAbs().maxCoeff(), .5, 3.5 * rho);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((mesh.points[t[i]] - mesh.points[t[(i + 1) % 3]]).head<2>().norm(), 6 * rho);
  }
}

// Returns a slope of 45 degrees with a gap around x = 0. The part to the right of the gap is `depth` lower.
Cloud broken_slope(double half_gap, double depth) {
  const Cloud slope = test::height_field(
      10000, 1, [](double x, double) { return x; }, [](double, double) { return Vec2(1, 0); });
  Cloud broken = test::where(slope, [&](const Vec3& p) { return std::abs(p.x()) >= half_gap; });
  for (Vec3& p : broken.points)
    if (p.x() > 0) p.z() -= depth;
  return broken;
}

TEST(FrontMesh, AGapInOneSurfaceTakesItsSlope) {
  const Cloud broken = broken_slope(.02, 0);
  const Mesh mesh = front_mesh(broken, measure_spacing(broken));
  EXPECT_NEAR(test::area_of(mesh.points, mesh.triangles), 4, .1);
  for (const auto& normals : mesh.corner_normals) EXPECT_LT(normals[0].z(), .71F);
}

TEST(FrontMesh, AGapBetweenTwoSurfacesShowsNothing) {
  const double half_gap = .035;
  const Cloud broken = broken_slope(half_gap, 3);
  const Mesh mesh = front_mesh(broken, measure_spacing(broken));
  EXPECT_NEAR(test::area_of(mesh.points, mesh.triangles), 4, .1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double x = 0;
    for (const Index corner : mesh.triangles[t]) x += mesh.points[corner].x() / 3;
    EXPECT_EQ(mesh.corner_normals[t][0].z() > .99F, std::abs(x) < half_gap) << x;
  }
}

TEST(FrontMesh, KeepsColours) {
  Cloud scene = test::joined(test::sheet(2000, 1, 0), test::sheet(2000, .5, 2, 8));
  for (const Vec3& p : scene.points)
    scene.colours.push_back({static_cast<std::uint8_t>(p.z() > 1 ? 250 : 50), 0, 0});
  const Mesh mesh = front_mesh(scene, measure_spacing(scene));
  ASSERT_EQ(mesh.colours.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_EQ(mesh.colours[i][0], mesh.points[i].z() > 1 ? 250 : 50);
}

TEST(FrontMesh, OfWhatTurnsAwayIsEmpty) {
  const Cloud sheet = test::inside_out(test::sheet(1000, 1, 0));
  EXPECT_TRUE(front_mesh(sheet, measure_spacing(sheet)).empty());
}

}  // namespace
}  // namespace relievo
