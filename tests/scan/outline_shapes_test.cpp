// Compares outlines of clouds with closed forms. The shapes have sharp corners, a hole, or noise.
#include <gtest/gtest.h>

#include "relievo/scan/surface.h"
#include "support/shapes.h"

namespace relievo {
namespace {

constexpr double pi = std::numbers::pi;

// The points on the boundary of a cloud, in the view plane, relative to the model's origin.
struct SeenOutline {
  std::vector<Vec2> places;
  double rho = 0;
};

SeenOutline outline_of(const Cloud& cloud, const View& view) {
  const Surface surface = *find_surface(cloud, view);
  SeenOutline outline{{}, surface.rho};
  const Vec3 centre = view.R_view_model * surface.centre;
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    if (surface.boundary.is_boundary[i]) outline.places.push_back((surface.points[i] + centre).head<2>());
  return outline;
}

// Statistics of the distances between points and a curve, in rho.
struct Deviation {
  double mean = 0, scatter = 0, farthest = 0;
};

template <typename Offset>
Deviation deviation(const SeenOutline& outline, Offset offset) {
  double sum = 0, squares = 0;
  Deviation result;
  for (const Vec2& place : outline.places) {
    const double off = offset(place) / outline.rho;
    sum += off, squares += off * off;
    result.farthest = std::max(result.farthest, std::abs(off));
  }
  const auto n = static_cast<double>(outline.places.size());
  result.mean = sum / n;
  result.scatter = std::sqrt(squares / n - sum * sum / (n * n));
  return result;
}

// The number of points of a scan, and the standard deviation of the noise along the normals, in rho. Scans
// with noise have no normals.
struct ScanKind {
  std::size_t points = 0;
  double noise = 0;
};

class OutlinesOfShapes : public testing::TestWithParam<ScanKind> {
 protected:
  static Cloud scan(Cloud cloud) {
    if (GetParam().noise == 0) return cloud;
    return test::without_normals(test::noisy(cloud, GetParam().noise * measure_spacing(cloud).rho, 0));
  }
};

TEST_P(OutlinesOfShapes, BothOfATorusAreAtTheTubesRadiusFromAnEllipse) {
  // A torus is the union of balls whose centres are on a circle. In the view this circle is an ellipse. So
  // the distance of both outlines of the torus from this ellipse is the radius of the balls.
  const SeenOutline outline =
      outline_of(scan(test::torus(GetParam().points, 2, .5)), *view_towards({0, -1, 1}));
  const auto inner = std::ranges::count_if(
      outline.places, [](const Vec2& p) { return Vec2(p.x() / 2, p.y() / std::sqrt(2.)).norm() < 1; });
  EXPECT_GT(static_cast<std::size_t>(inner), outline.places.size() / 4);
  const Deviation off =
      deviation(outline, [](const Vec2& p) { return test::distance_from_ellipse(p, 2, std::sqrt(2.)) - .5; });
  const bool is_clean = GetParam().noise == 0;
  EXPECT_LT(off.farthest, is_clean ? .15 : .3);
  EXPECT_LT(off.scatter, is_clean ? .02 : .07);
}

// The number of a flat gear's teeth, and the radii of its gaps and of its teeth.
constexpr int teeth = 12;
constexpr double root = .8, tip = 1;

Cloud gear(std::size_t n) {
  test::Random random(23);
  Cloud cloud;
  while (cloud.size() < n) {
    const Vec2 p(random.uniform(-tip, tip), random.uniform(-tip, tip));
    const double sector = std::floor(std::atan2(p.y(), p.x()) * teeth / pi);
    const bool is_tooth = std::fmod(sector + 2 * teeth, 2) == 0;
    if (p.norm() < (is_tooth ? tip : root)) test::add(cloud, {p.x(), p.y(), 0}, Vec3::UnitZ());
  }
  return cloud;
}

TEST_P(OutlinesOfShapes, KeepTheCornersOfAGear) {
  // The points are scattered, so on each side of a corner the position of the outline is uncertain by half a
  // sampling distance.
  const SeenOutline outline = outline_of(scan(gear(GetParam().points)), View{});
  std::vector<double> off;
  for (int k = 0; k < 2 * teeth; ++k)
    for (const double radius : {root, tip}) {
      const Vec2 corner = radius * Vec2(std::cos(k * pi / teeth), std::sin(k * pi / teeth));
      double nearest = 1e9;
      for (const Vec2& place : outline.places) nearest = std::min(nearest, (place - corner).norm());
      off.push_back(nearest / outline.rho);
    }
  std::ranges::sort(off);
  EXPECT_LT(off[off.size() / 2], .5);
  EXPECT_LT(off[off.size() * 9 / 10], 1);
  EXPECT_LT(off.back(), 3);
}

INSTANTIATE_TEST_SUITE_P(Clean, OutlinesOfShapes, testing::Values(ScanKind{20000}, ScanKind{100000}));
INSTANTIATE_TEST_SUITE_P(Noisy, OutlinesOfShapes,
                         testing::Values(ScanKind{20000, .15}, ScanKind{100000, .15}));
// This test takes minutes, so it runs only with --gtest_also_run_disabled_tests.
INSTANTIATE_TEST_SUITE_P(DISABLED_Large, OutlinesOfShapes,
                         testing::Values(ScanKind{1000000}, ScanKind{1000000, .15}));

TEST(NoisyOutlines, AreTooWideUnlessNoiseIsRemoved) {
  // The outermost points of a noisy cloud are outside the true silhouette.
  const Cloud clean = test::button(50000, 1, .15);
  const double rho = measure_spacing(clean).rho;
  const Cloud noisy = test::without_normals(test::noisy(clean, .5 * rho, 0));
  const auto off_the_circle = [](const Vec2& p) { return p.norm() - 1.15; };
  View kept{.denoise = 0};
  const Deviation with_noise = deviation(outline_of(noisy, kept), off_the_circle);
  const Deviation without = deviation(outline_of(noisy, View{}), off_the_circle);
  EXPECT_GT(with_noise.mean, .4);
  EXPECT_LT(without.mean, .3);
  EXPECT_LT(without.scatter, .3);
  EXPECT_LT(without.farthest, 1.5);
}

}  // namespace
}  // namespace relievo
