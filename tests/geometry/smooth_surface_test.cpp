#include "geometry/smooth_surface.h"

#include "relievo/geometry/triangulation.h"
#include "support/planar_points.h"
#include "support/triangles.h"

namespace relievo {
namespace {

std::vector<Vec2> places_of(const std::vector<Vec3>& points) {
  std::vector<Vec2> places;
  for (const Vec3& p : points) places.push_back(p.head<2>());
  return places;
}

// A triangulation of random points in the unit square, with the heights f(p).
struct Field {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  template <typename F>
  Field(std::size_t n, F f) {
    const std::vector<Vec2> plane = random_points(n, 11);
    for (const Vec2& p : plane) points.emplace_back(p.x(), p.y(), f(p));
    triangles = delaunay(plane).triangles;
  }

  std::vector<std::uint8_t> all_smooth() const { return std::vector<std::uint8_t>(triangles.size(), 1); }

  Vec2 place(std::size_t t, double u, double v) const {
    const auto& [a, b, c] = triangles[t];
    return u * points[a].head<2>() + v * points[b].head<2>() + (1 - u - v) * points[c].head<2>();
  }
};

double paraboloid(const Vec2& p) {
  return .3 + p.x() - .5 * p.y() + 2 * p.x() * p.x() - p.x() * p.y() + .7 * p.y() * p.y();
}
Vec2 paraboloid_slope(const Vec2& p) {
  return {1 + 4 * p.x() - p.y(), -.5 - p.x() + 1.4 * p.y()};
}

TEST(SmoothSurface, ReproducesQuadratics) {
  const Field field(2000, paraboloid);
  const std::vector<std::uint8_t> smooth = field.all_smooth();
  const SmoothSurface surface(field.points, field.triangles, smooth);
  for (std::size_t t = 0; t < field.triangles.size(); ++t)
    for (const auto& [u, v] : {std::pair(.33, .34), std::pair(.6, .1), std::pair(.05, .9)}) {
      const Vec2 place = field.place(t, u, v);
      if ((place - Vec2(.5, .5)).cwiseAbs().maxCoeff() > .4) continue;
      const SmoothSurface::Sample sample = surface.at(static_cast<Index>(t), place);
      EXPECT_NEAR(sample.height, paraboloid(place), 2e-5);
      EXPECT_LT((sample.slope - paraboloid_slope(place)).norm(), 1e-2);
    }
}

// The points stand in rows, as they do along outlines, and the surface bends by 21 degrees at one row. The
// slope along the rows must be constant, because otherwise every triangle would be visible as a bead.
TEST(SmoothSurface, BendsBetweenRowsAsIfThereWereNoTriangles) {
  const double bend = .45;
  std::vector<Vec3> points;
  for (int row = 0; row < 12; ++row)
    for (int i = 0; i < 40; ++i) {
      const double x = row * .1, y = (i + .5 * (row % 2)) * .09;
      points.emplace_back(x, y, x < .55 ? bend * x : bend * .5 + .05 * (x - .5));
    }
  const std::vector<Vec2> plane = places_of(points);
  const std::vector<Triangle> triangles = delaunay(plane).triangles;
  const std::vector<std::uint8_t> smooth(triangles.size(), 1);
  const SmoothSurface surface(points, triangles, smooth);
  for (int column = 20; column < 90; ++column) {
    const double x = .0103 * column;
    Vec2 least = Vec2::Constant(1e9), most = -least;
    for (Index t = 0; t < triangles.size(); ++t)
      for (int k = 0; k < 40; ++k) {
        const Vec2 place(x, 1 + .0197 * k);
        const auto& [a, b, c] = triangles[t];
        const auto is_left = [&](Index i, Index j) {
          return test::twice_area(plane[i], plane[j], place) >= 0;
        };
        if (!is_left(a, b) || !is_left(b, c) || !is_left(c, a)) continue;
        const Vec2 slope = surface.at(t, place).slope;
        least = least.cwiseMin(slope), most = most.cwiseMax(slope);
      }
    EXPECT_LT((most - least).maxCoeff(), .02) << x;
  }
}

TEST(SmoothSurface, InterpolatesItsPoints) {
  const Field field(300, [](const Vec2& p) { return std::sin(20 * p.x()) * std::cos(13 * p.y()); });
  const std::vector<std::uint8_t> smooth = field.all_smooth();
  const SmoothSurface surface(field.points, field.triangles, smooth);
  for (std::size_t t = 0; t < field.triangles.size(); ++t)
    for (const Index i : field.triangles[t])
      EXPECT_NEAR(surface.at(static_cast<Index>(t), field.points[i].head<2>()).height, field.points[i].z(),
                  1e-9);
}

TEST(SmoothSurface, HasTheSameHeightAndSlopeOnBothSidesOfAnEdge) {
  const Field field(300, [](const Vec2& p) { return std::sin(20 * p.x()) * std::cos(13 * p.y()); });
  const std::vector<std::uint8_t> smooth = field.all_smooth();
  const SmoothSurface surface(field.points, field.triangles, smooth);
  const Triangulation mesh = delaunay(places_of(field.points));
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index other = mesh.neighbours[t][i];
      if (other == no_index) continue;
      const Vec2 a = field.points[mesh.triangles[t][(i + 1) % 3]].head<2>(),
                 b = field.points[mesh.triangles[t][(i + 2) % 3]].head<2>();
      for (const double share : {.2, .5, .85}) {
        const Vec2 place = a + share * (b - a);
        const auto here = surface.at(t, place), there = surface.at(other, place);
        EXPECT_NEAR(here.height, there.height, 1e-9);
        EXPECT_LT((here.slope - there.slope).norm(), 1e-6 * (1 + here.slope.norm()));
      }
    }
}

TEST(SmoothSurface, LeavesOtherTrianglesPlane) {
  const Field field(500, paraboloid);
  const std::vector<std::uint8_t> plane(field.triangles.size(), 0);
  const SmoothSurface surface(field.points, field.triangles, plane);
  for (std::size_t t = 0; t < field.triangles.size(); ++t) {
    const auto& [a, b, c] = field.triangles[t];
    const double mean = (field.points[a].z() + field.points[b].z() + field.points[c].z()) / 3;
    EXPECT_NEAR(surface.at(static_cast<Index>(t), field.place(t, 1 / 3., 1 / 3.)).height, mean, 1e-9);
  }
}

// A step joins two level halves. The triangles of the step are not marked as smooth. Both halves must stay
// exactly level.
TEST(SmoothSurface, DoesNotSwingBesideAWall) {
  const Field field(3000, [](const Vec2& p) { return p.x() < .5 ? 0. : 1.; });
  std::vector<std::uint8_t> smooth = field.all_smooth();
  for (std::size_t t = 0; t < smooth.size(); ++t) {
    const auto& [a, b, c] = field.triangles[t];
    smooth[t] = field.points[a].z() == field.points[b].z() && field.points[b].z() == field.points[c].z();
  }
  const SmoothSurface surface(field.points, field.triangles, smooth);
  for (std::size_t t = 0; t < smooth.size(); ++t)
    if (smooth[t])
      EXPECT_NEAR(surface.at(static_cast<Index>(t), field.place(t, .2, .3)).height,
                  field.points[field.triangles[t][0]].z(), 1e-12);
}

}  // namespace
}  // namespace relievo
