#include "plate/height_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/plane.h"
#include "relievo/plate/solid.h"
#include "support/plate_fronts.h"

namespace relievo {
namespace {

using test::grid_front, test::plate_of;

// Returns the height of the front above its lowest point at a place, by trying all triangles; 0 where there is none.
double height_at(const Solid& solid, const Box& box, const Vec2& place) {
  double highest = 0;
  for (std::size_t t = 0; t < solid.front_triangles; ++t) {
    const auto corner = [&](std::size_t i) -> Vec3 {
      return solid.points[solid.triangles[t][i]].cast<float>().cast<double>();
    };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const auto turn = [&](const Vec3& p, const Vec3& q) {
      return cross(Vec2((q - p).head<2>()), Vec2(place - p.head<2>()));
    };
    const Vec3 weights(turn(b, c), turn(c, a), turn(a, b));
    if (weights.minCoeff() < 0) continue;
    highest = std::max(highest, weights.dot(Vec3(a.z(), b.z(), c.z())) / weights.sum() - box.min.z());
  }
  return highest;
}

void expect_heights_of(const Solid& solid) {
  const HeightField field = measure_height_field(solid, 97);
  ASSERT_FALSE(field.z.empty());
  for (int y = 0; y < field.z.height; ++y)
    for (int x = 0; x < field.z.width; ++x)
      ASSERT_NEAR(field.z.at(x, y), height_at(solid, field.box, field.to_mm(x + .5, y + .5)), 2e-5)
          << x << ", " << y;
}

double waves(double x, double y) {
  return 2 + std::sin(x) + std::sin(1.3 * y);
}

// Such flat bevels, and folds, were once smoothed by up to .7 mm.
TEST(HeightField, IsTheTrianglesHeightUnderEachCentre) {
  for (const auto& [name, outline] : outline_choices)
    for (const double bevel : {.1, .6, 2.}) {
      PlateOptions options;
      options.outline = outline;
      if (outline != Outline::none) options.rim = {2, bevel == .1 ? -1. : 1., bevel};
      SCOPED_TRACE(testing::Message() << name << ", bevel " << bevel);
      expect_heights_of(plate_of(grid_front({20, 20, 20, 20}, waves), options));
    }
}

TEST(HeightField, IsTheTrianglesHeightOnBases) {
  for (const char* base : {"fold:angle=20", "fold:angle=15,direction=30", "wave:height=5,length=12",
                           "cylinder:diameter=60", "dome:height=4,hollow"}) {
    PlateOptions options;
    options.base = parse_base(base).value();
    for (const double tolerance : {0., .05}) {
      options.simplify_mm = tolerance;
      SCOPED_TRACE(base);
      expect_heights_of(plate_of(grid_front({20, 20, 20, 20}, waves), options));
    }
  }
}

// Walls are too steep for a rasteriser with fixed fractions of a pixel.
TEST(HeightField, TellsOnWhichSideOfAWallAPixelIs) {
  const auto wall = [](double x, double) { return x < 10 ? 3. : 0.; };
  HeightFieldMesh front = grid_front({20, 20, 20, 20}, wall);
  for (Vec3& p : front.points)
    if (p.x() == 9) p.x() = 10 - 1e-5;
  expect_heights_of(plate_of(front, {5}));
}

}  // namespace
}  // namespace relievo
