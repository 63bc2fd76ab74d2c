#include "relievo/scan/boundary.h"

#include "relievo/scan/spacing.h"
#include "support/shapes.h"
#include "support/triangles.h"

namespace relievo {
namespace {

// A flat cloud whose points are all visible, with the triangulation and the boundary of the points.
struct FlatCase {
  std::vector<Vec2> points;
  double rho;
  Triangulation mesh;
  Boundary boundary;

  explicit FlatCase(const Cloud& cloud) : rho(measure_spacing(cloud).rho) {
    for (const Vec3& p : cloud.points) points.push_back(p.head<2>());
    mesh = delaunay(points);
    boundary = find_boundary(points, mesh, rho);
  }

  double inside_area() const { return test::inside_area(points, mesh, boundary); }
};

TEST(Boundary, OfASquareIsItsRimOnePointThick) {
  const FlatCase square(test::sheet(40000, 1, 0));
  EXPECT_NEAR(square.inside_area(), 4, .04);  // random points do not reach the square's edge
  const double rho = square.rho;
  std::size_t count = 0;
  for (std::size_t i = 0; i < square.points.size(); ++i) {
    if (!square.boundary.is_boundary[i]) continue;
    ++count;
    EXPECT_GT(square.points[i].cwiseAbs().maxCoeff(), 1 - 4 * rho);
  }
  EXPECT_LT(static_cast<double>(count), 1.5 * 8 / rho);  // the edge is 8 long; at most 1.5 points per rho
}

TEST(Boundary, OfARingHasTheInnerHole) {
  const auto is_ring = [](const Vec3& p) { return p.head<2>().norm() < 1 && p.head<2>().norm() > .4; };
  const FlatCase ring(test::where(test::sheet(40000, 1, 0), is_ring));
  EXPECT_NEAR(ring.inside_area(), 3.14159 * (1 - .16), .06);
  std::size_t inner = 0;
  for (std::size_t i = 0; i < ring.points.size(); ++i)
    inner += ring.boundary.is_boundary[i] && ring.points[i].norm() < .5;
  EXPECT_GT(inner, 100U);
}

TEST(Boundary, ClosesPinHolesOfSampling) {
  const Cloud whole = test::sheet(40000, 1, 0);
  const double rho = measure_spacing(whole).rho;
  const FlatCase pinholes(
      test::where(whole, [&](const Vec3& p) { return (p - Vec3(.3, .3, 0)).norm() > 3.5 * rho; }));
  for (std::size_t i = 0; i < pinholes.points.size(); ++i) {
    const bool is_inner = pinholes.points[i].cwiseAbs().maxCoeff() < .9;
    ASSERT_FALSE(is_inner && pinholes.boundary.is_boundary[i]);
  }
}

TEST(Boundary, OfAPlaneGraphHasItsDistances) {
  const FlatCase square(test::sheet(5000, 1, 0));
  for (std::size_t i = 0; i < square.points.size(); i += 50) {
    double nearest = 1e9;
    for (std::size_t j = 0; j < square.points.size(); ++j)
      if (square.boundary.is_boundary[j])
        nearest = std::min(nearest, (square.points[i] - square.points[j]).norm());
    EXPECT_FLOAT_EQ(square.boundary.distance[i], static_cast<float>(nearest));
  }
}

}  // namespace
}  // namespace relievo
