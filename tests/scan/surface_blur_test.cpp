#include "scan/surface_blur.h"

#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

TEST(SurfaceBlur, KeepsAConstant) {
  const Cloud sphere = test::sphere(20000, 1);
  std::vector<Vec2f> values(sphere.size(), Vec2f(3, -2));
  SurfaceBlur(sphere.points, .1).apply(values);
  for (const Vec2f& v : values) ASSERT_LT((v - Vec2f(3, -2)).norm(), 1e-5);
}

// A Gaussian of standard deviation s multiplies a wave with wave number k by exp(-(s k)^2 / 2).
TEST(SurfaceBlur, WeakensWavesAsAGaussianDoes) {
  const Cloud sheet = test::sheet(100000, 1, 0);
  for (const double sigma : {.03, .06})
    for (const double phase : {.3, .7, 1.0}) {
      const double k = phase / sigma;
      std::vector<Vec2f> values(sheet.size());
      for (std::size_t i = 0; i < sheet.size(); ++i)
        values[i] = {static_cast<float>(std::sin(k * sheet.points[i].x())), 0};
      SurfaceBlur(sheet.points, sigma).apply(values);
      double sum = 0, weight = 0;
      for (std::size_t i = 0; i < sheet.size(); ++i) {
        const Vec3& p = sheet.points[i];
        if (std::abs(p.x()) > .7 || std::abs(p.y()) > .7) continue;
        const double wave = std::sin(k * p.x());
        sum += wave * static_cast<double>(values[i].x()), weight += wave * wave;
      }
      EXPECT_NEAR(sum / weight, std::exp(-phase * phase / 2), .02) << sigma << ' ' << phase;
    }
}

TEST(SurfaceBlur, DoesNotReachASheetBehind) {
  const Cloud both = test::joined(test::sheet(20000, 1, 0), test::sheet(20000, 1, 1, 9));
  std::vector<Vec2f> values(both.size());
  for (std::size_t i = 0; i < both.size(); ++i) values[i] = {static_cast<float>(both.points[i].z()), 0};
  SurfaceBlur(both.points, .1).apply(values);
  for (std::size_t i = 0; i < both.size(); ++i) ASSERT_NEAR(values[i].x(), both.points[i].z(), 1e-6);
}

// A grid over the bounding box of all points would have about 200 x 200 x 200 cells, which is far too many.
TEST(SurfaceBlur, HasCellsAroundThePointsAlone) {
  const std::vector<Vec3> four = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {1, 1, .5}};
  EXPECT_LE(SurfaceBlur(four, .0045).number_of_cells(), 4U * 4 * 4 * 4);
  Cloud steep = test::sheet(50000, 1, 0);
  for (Vec3& p : steep.points) p.z() = p.x();
  EXPECT_LT(SurfaceBlur(steep.points, .01).number_of_cells(), 190U * 190 * 8);
}

TEST(SurfaceBlur, TakesAnyWidthAndExtent) {
  Cloud line = test::sheet(100, 1, 0);
  for (Vec3& p : line.points) p.y() = 1e6 * p.x();
  for (const double sigma : {1e-9, 1.0, 1e9}) {
    std::vector<Vec2f> values(line.size(), Vec2f(1, 0));
    SurfaceBlur(line.points, sigma).apply(values);
    for (const Vec2f& v : values) ASSERT_NEAR(v.x(), 1, 1e-5);
  }
}

TEST(SurfaceBlur, HasTheSameBitsForAnyNumberOfThreads) {
  const Cloud sphere = test::sphere(30000, 1);
  test::expect_same_for_any_threads([&] {
    std::vector<Vec2f> values(sphere.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = sphere.normals[i].head<2>();
    SurfaceBlur(sphere.points, .05).apply(values);
    return values;
  });
}

}  // namespace
}  // namespace relievo
