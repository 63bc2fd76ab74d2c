#include "relievo/scan/mesh.h"
#include "relievo/scan/scan_file.h"

#include <Eigen/Geometry>

#include "relievo/make_relief.h"
#include "support/mesh_shapes.h"
#include "support/results.h"

namespace relievo {
namespace {

Mesh square(double z, bool looks_away = false) {
  Mesh mesh{{{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, {{0, 1, 2}, {0, 2, 3}}};
  if (looks_away)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

const View front = *parse_view("front");

TEST(SampleMesh, GivesAboutTheNumberAskedForOnTheVisibleSide) {
  for (const double wanted : {2000.0, 50000.0}) {
    const auto cloud = value_of(sample_mesh(test::sphere_mesh(1, 120), front, {wanted}));
    EXPECT_NEAR(static_cast<double>(cloud.size()), wanted, .15 * wanted);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      EXPECT_GT(cloud.points[i].z(), -.05);
      EXPECT_NEAR(cloud.points[i].norm(), 1, 2e-3);
      EXPECT_GT(cloud.normals[i].z(), 0);
    }
  }
}

TEST(SampleMesh, NormalsAreThoseOfTheSmoothShape) {
  const auto cloud = value_of(sample_mesh(test::sphere_mesh(1, 80), front, {20000}));
  double sum = 0, worst = 0;
  std::size_t inner = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.points[i].z() < .2) continue;
    const double sine = cloud.normals[i].cast<double>().cross(cloud.points[i].normalized()).norm();
    sum += std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi;
    worst = std::max(worst, sine);
    ++inner;
  }
  EXPECT_LT(sum / static_cast<double>(inner), .1);  // the triangles' own normals have errors of 1.5 degrees
  EXPECT_LT(worst, std::sin(1 * std::numbers::pi / 180));
}

TEST(SampleMesh, ThePointsLieOnTheMeshInAnyView) {
  const View view = *view_towards(Vec3(1, -2, .5), Vec3(0, 0, 1));
  const auto cloud = value_of(sample_mesh(square(3), view, {10000}));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.points[i].z(), 3, 1e-6);
    EXPECT_LE(cloud.points[i].head<2>().cwiseAbs().maxCoeff(), 1 + 1e-3);
    EXPECT_LT((cloud.normals[i] - Vec3f::UnitZ()).norm(), 1e-5F);
  }
}

TEST(SampleMesh, TheNearerSurfaceHidesTheOther) {
  Mesh nearer = square(1, true);  // the nearer square faces away, but still hides the other one
  for (Vec3& p : nearer.points) p.head<2>() *= .5;
  const auto cloud = value_of(sample_mesh(test::joined(square(0), nearer), front, {10000}));
  std::size_t near = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_inside = cloud.points[i].head<2>().cwiseAbs().maxCoeff() < .499;
    const bool is_outside = cloud.points[i].head<2>().cwiseAbs().maxCoeff() > .501;
    if (is_inside || is_outside) EXPECT_NEAR(cloud.points[i].z(), is_inside ? 1 : 0, 1e-6);
    near += is_inside;
    EXPECT_GT(cloud.normals[i].z(), .99F);
  }
  EXPECT_NEAR(static_cast<double>(near) / static_cast<double>(cloud.size()), .25, .02);
}

TEST(SampleMesh, TheOutlineIsFinerThanTheGrid) {
  const auto cloud = value_of(sample_mesh(test::sphere_mesh(1, 400), front, {3000}));
  const double pixel = std::sqrt(std::numbers::pi / 3000);
  // `reach` is the largest distance of a sample from the centre, in each of 90 directions. It would be too
  // small by up to a pixel if samples were only on the grid.
  std::vector<double> reach(90, 0);
  for (const Vec3& p : cloud.points) {
    const double angle = std::atan2(p.y(), p.x()) + std::numbers::pi;
    double& r =
        reach[std::min<std::size_t>(89, static_cast<std::size_t>(angle / (2 * std::numbers::pi) * 90))];
    r = std::max(r, p.head<2>().norm());
  }
  for (const double r : reach) EXPECT_GT(r, 1 - .55 * pixel);
}

TEST(SampleMesh, FindsAWireThatIsAThousandTimesLongerThanWide) {
  Mesh mesh = square(0);
  for (Vec3& p : mesh.points) p.x() *= 2e-4;
  EXPECT_GT(value_of(sample_mesh(mesh, front, {5000})).size(), 1000U);
}

TEST(SampleMesh, ColoursAreInterpolated) {
  Mesh mesh = square(0);
  mesh.colours = {{0, 0, 0}, {200, 0, 0}, {200, 100, 0}, {0, 100, 0}};
  const auto cloud = value_of(sample_mesh(mesh, front, {1000}));
  ASSERT_EQ(cloud.colours.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.colours[i][0], 100 * (cloud.points[i].x() + 1), 1.5);
    EXPECT_NEAR(cloud.colours[i][1], 50 * (cloud.points[i].y() + 1), 1.5);
  }
}

TEST(SampleMesh, NothingToSeeIsAnError) {
  expect_error(sample_mesh(square(0), *parse_view("right"), {1000}), ErrorKind::geometry);
  EXPECT_EQ(sample_mesh({}, front).error().kind, ErrorKind::geometry);
  EXPECT_EQ(sample_mesh(square(0), front, {5}).error().kind, ErrorKind::option);
  Cancelled progress;
  EXPECT_EQ(sample_mesh(square(0), front, {1000}, &progress).error().kind, ErrorKind::cancelled);
}

TEST(Scatter, IsEvenByAreaOnAllSides) {
  const Cloud cloud = scatter(test::sphere_mesh(1, 80), 20000);
  EXPECT_EQ(cloud.size(), 20000U);
  std::array<int, 8> octants = {};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3& p = cloud.points[i];
    EXPECT_NEAR(p.norm(), 1, 4e-3);
    EXPECT_GT(cloud.normals[i].dot(p.cast<float>()), .99F);
    ++octants[static_cast<std::size_t>((p.x() > 0) + 2 * (p.y() > 0) + 4 * (p.z() > 0))];
  }
  for (const int n : octants) EXPECT_NEAR(n, 2500, 60);
  EXPECT_EQ(scatter({}, 100).size(), 0U);
}

TEST(SmoothNormals, StopAtCreases) {
  // Returns two squares with a common edge. The second square is rotated by `degrees` out of the plane of the first.
  const auto bent = [](double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    return Mesh{{{0, 0, 0},
                 {0, 1, 0},
                 {-1, 1, 0},
                 {-1, 0, 0},
                 {std::cos(a), 0, std::sin(a)},
                 {std::cos(a), 1, std::sin(a)}},
                {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}}};
  };
  for (const auto& normals : smooth_normals(bent(90)))
    for (const Vec3f& n : normals) EXPECT_NEAR(n.cwiseAbs().maxCoeff(), 1, 1e-6);
  const Mesh shallow = bent(20);
  const auto normals = smooth_normals(shallow);
  const Vec3f middle(static_cast<float>(-std::sin(std::numbers::pi / 18)), 0,
                     static_cast<float>(std::cos(std::numbers::pi / 18)));
  EXPECT_LT((normals[0][0] - middle).norm(), 1e-3F);
  EXPECT_LT((normals[3][2] - middle).norm(), 1e-3F);
}

TEST(MakeRelief, OfAMeshIsThatOfItsDenseCloud) {
  CloudFile file;
  file.mesh = test::sphere_mesh(1, 24);  // its own points are 0.26 apart, too far for a good relief
  file.cloud.points = file.mesh.points;
  ReliefOptions options{{.height_mm = 5, .points = 20000}};
  const auto made = value_of(make_relief(file, options));
  EXPECT_EQ(check_solid(made.solid), "");
  EXPECT_NEAR(made.report.height_mm, 5, .01);
  EXPECT_NEAR(static_cast<double>(made.report.visible_points), 20000, 3000);
}

}  // namespace
}  // namespace relievo
