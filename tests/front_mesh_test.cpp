#include "front_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "shapes.h"

namespace relievo {
namespace {

double area_in_plane(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.points[b] - mesh.points[a], q = mesh.points[c] - mesh.points[a];
    area += .5 * p.cross(q).z();
  }
  return area;
}

TEST(FrontMesh, CoversWhatIsSeen) {
  const Cloud ball = test::sphere(10000, 1);
  const Mesh mesh = front_mesh(ball, measure_spacing(ball));
  EXPECT_NEAR(area_in_plane(mesh), std::numbers::pi, .02 * std::numbers::pi);
  ASSERT_EQ(mesh.corner_normals.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = mesh.points[mesh.triangles[t][i]];
      EXPECT_GT(p.z(), -.1);
      EXPECT_GT(p.normalized().dot(mesh.corner_normals[t][i].cast<double>()), .98);
    }
}

TEST(FrontMesh, LeavesNoGapAndNoWallWhereTheDepthJumps) {
  const Cloud scene = test::joined(test::sheet(4000, 1, 0), test::sheet(4000, .5, 2, 8));
  const Mesh mesh = front_mesh(scene, measure_spacing(scene));
  EXPECT_NEAR(area_in_plane(mesh), 4, .1);
  for (const Vec3& p : mesh.points) EXPECT_LT(std::min(std::abs(p.z()), std::abs(p.z() - 2)), 1e-9);
  for (const auto& [a, b, c] : mesh.triangles) {
    EXPECT_EQ(mesh.points[a].z() > 1, mesh.points[b].z() > 1);
    EXPECT_EQ(mesh.points[a].z() > 1, mesh.points[c].z() > 1);
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
  Cloud sheet = test::sheet(1000, 1, 0);
  for (Vec3f& n : sheet.normals) n = -n;
  EXPECT_TRUE(front_mesh(sheet, measure_spacing(sheet)).empty());
}

}  // namespace
}  // namespace relievo
