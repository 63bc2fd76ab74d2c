
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plate/front/sample_front.h"
#include "support/triangles.h"

namespace relievo {
namespace {

// A square grid of points on a roof. Its ridge runs along the diagonal from the lower left corner or, if
// `direction` is -1, from the upper left corner.
struct Roof {
  std::vector<Vec2> points;
  std::vector<Vec2f> slopes;
  std::vector<double> heights;
  Triangulation mesh;

  explicit Roof(double direction) {
    constexpr int side = 12;
    for (int i = 0; i < side * side; ++i) {
      const Vec2 p(.1 * (i % side), .1 * (i / side));
      const double across = p.x() - (direction > 0 ? p.y() : .1 * (side - 1) - p.y());
      const auto sign = static_cast<float>((across > 1e-9) - (across < -1e-9));
      points.push_back(p);
      slopes.push_back(-sign * Vec2f(1, static_cast<float>(-direction)));
      heights.push_back(-std::abs(across));
    }
    mesh = delaunay(points);
  }

  // Returns the largest vertical distance between the roof and the midpoints of the mesh's edges.
  double error(double direction) const {
    double most = 0;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3];
        const Vec2 middle = (points[a] + points[b]) / 2;
        const double across = middle.x() - (direction > 0 ? middle.y() : 1.1 - middle.y());
        most = std::max(most, std::abs((heights[a] + heights[b]) / 2 + std::abs(across)));
      }
    return most;
  }
};

TEST(Diagonals, FollowARidge) {
  // For at least one direction of the ridge, edges of the Delaunay triangulation cross the ridge.
  EXPECT_GT(std::max(Roof(1).error(1), Roof(-1).error(-1)), .05);
  for (const double direction : {1., -1.}) {
    Roof roof(direction);
    turn_diagonals(roof.points, roof.slopes, roof.mesh);
    EXPECT_LT(roof.error(direction), 1e-9);
    test::expect_counter_clockwise(roof.points, roof.mesh.triangles);
    EXPECT_NEAR(test::area_of(roof.points, roof.mesh.triangles), 1.1 * 1.1, 1e-12);
  }
}

TEST(Diagonals, StayWhereSlopesAreUnknown) {
  for (const double direction : {1., -1.}) {
    Roof roof(direction);
    roof.slopes.assign(roof.slopes.size(), Vec2f::Constant(std::numeric_limits<float>::quiet_NaN()));
    const std::vector<Triangle> before = roof.mesh.triangles;
    turn_diagonals(roof.points, roof.slopes, roof.mesh);
    EXPECT_EQ(roof.mesh.triangles, before);
  }
}

}  // namespace
}  // namespace relievo
