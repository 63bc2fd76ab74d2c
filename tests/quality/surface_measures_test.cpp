#include "quality/surface_measures.h"

#include "support/surfaces.h"

namespace relievo {
namespace {

using test::surface_of;

constexpr double pi = std::numbers::pi;

// Returns the surface of a button of radius 1.
const Surface& disc() {
  static const Surface surface = surface_of(test::button(40000, .85, .15));
  return surface;
}

// Returns heights that rise inwards, from 0 at radius 1. Their slope is a function of the azimuth.
template <typename Slope>
std::vector<double> rising(const Surface& surface, Slope slope) {
  std::vector<double> z;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vec2 p = (surface.points[i] + surface.centre).head<2>();
    z.push_back(surface.boundary.is_boundary[i] ? 0 : (1 - p.norm()) * slope(std::atan2(p.y(), p.x())));
  }
  return z;
}

TEST(SurfaceMeasures, AConeHasNoFray) {
  const SurfaceMeasures measures(disc());
  EXPECT_LT(measures.fray(rising(disc(), [](double) { return .5; })).silhouette_deg, .3);
  EXPECT_EQ(measures.fray(rising(disc(), [](double) { return .5; })).jump_deg, 0);
}

// The tilt is a sine along the rim, whose wavelength is ten triangles. Fray is the deviation of the tilt
// from its moving mean over 25 triangles. The moving mean is a sine, too; its amplitude is that of the tilt
// times 1 / (25 sin(pi / 10)).
TEST(SurfaceMeasures, FrayOfWavesIsTheirRootMeanSquare) {
  const double rims = 2 * pi / (.75 * disc().rho), amplitude = .1;
  const int waves = static_cast<int>(rims / 10);
  const SurfaceMeasures measures(disc());
  const double fray =
      measures.fray(rising(disc(), [&](double angle) { return amplitude * std::sin(waves * angle); }))
          .silhouette_deg;
  const double rest = 1 - 1 / (25 * std::sin(pi / 10));
  EXPECT_NEAR(fray, rest * amplitude / std::sqrt(2) * 180 / pi, .2);
}

// The tilt changes slowly along the rim. Slow changes must not count as fray.
TEST(SurfaceMeasures, FrayLeavesOutTheSmoothCourse) {
  const SurfaceMeasures measures(disc());
  EXPECT_LT(measures.fray(rising(disc(), [](double angle) { return .5 + .1 * std::sin(3 * angle); }))
                .silhouette_deg,
            .4);
}

TEST(SurfaceMeasures, FrayAtAJumpGrowsWithNoise) {
  const Surface sheets = surface_of(test::joined(test::sheet(40000, 1, 0), test::button(10000, .5, .075, 3)));
  const SurfaceMeasures measures(sheets);
  std::vector<double> z;
  for (const Vec3& p : sheets.points) z.push_back(.2 * (p + sheets.centre).head<2>().norm());
  EXPECT_GT(measures.fray(z).jump_deg, 0);  // the circle consists of chords
  EXPECT_LT(measures.fray(z).jump_deg, .5);
  test::Random random(5);
  std::vector<double> noisy = z;
  for (double& value : noisy) value += .05 * sheets.rho * random.gaussian();
  EXPECT_GT(measures.fray(noisy).jump_deg, 3);
}

// Between neighbouring triangles on a ball, the normal turns by an angle: the distance of the triangles'
// centres divided by the ball's radius.
TEST(SurfaceMeasures, FacetAngleIsThatOfTheTriangles) {
  const Surface cap = surface_of(test::sheet(40000, .5, 0));
  const SurfaceMeasures measures(cap);
  std::vector<double> ball, plane;
  for (const Vec3& p : cap.points) {
    ball.push_back(std::sqrt(4 - p.head<2>().squaredNorm()));
    plane.push_back(.3 * p.x() - .2 * p.y());
  }
  EXPECT_LT(measures.facet_angle_deg(plane), 1e-3);
  const double of_rho = measures.facet_angle_deg(ball) * pi / 180 * 2 / cap.rho;
  EXPECT_GT(of_rho, .8);  // 0.58 is the value of equilateral triangles with sides of rho
  EXPECT_LT(of_rho, 2.5);
}

TEST(SurfaceMeasures, LongestSideIsThatOfAGap) {
  EXPECT_LT(SurfaceMeasures(disc()).longest_side(), 4);
  EXPECT_GT(SurfaceMeasures(disc()).longest_side(), 1);
}

}  // namespace
}  // namespace relievo
