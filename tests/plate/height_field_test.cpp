#include "plate/height_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "relievo/plate/solid.h"
#include "support/plate_fronts.h"

namespace relievo {
namespace {

using test::grid_front;

Solid plate_of(const HeightFieldMesh& front) {
  PlateOptions options;
  options.margin_mm = 5;
  return make_plate(front, options).value();
}

// A cap of a paraboloid on a square of 20 mm.
double cap(double x, double y) {
  return 2 - .02 * ((x - 10) * (x - 10) + (y - 10) * (y - 10));
}

TEST(SmoothHeightField, OfAParaboloidIsOneBetweenTheCornersToo) {
  const Solid solid = plate_of(grid_front({20, 20, 20, 20}, cap));
  const HeightField field = draw_smooth_height_field(solid, 600), plane = draw_height_field(solid, 600);
  const double lowest = field.box.min.z() - solid.ground_mm;
  double worst = 0, worst_plane = 0;
  for (int y = 0; y < field.z.height; ++y)
    for (int x = 0; x < field.z.width; ++x) {
      const Vec2 mm = field.to_mm(x + .5, y + .5) - Vec2(5, 5);
      if ((mm - Vec2(10, 10)).cwiseAbs().maxCoeff() > 6) continue;
      worst = std::max(worst, std::abs(lowest + field.z.at(x, y) - cap(mm.x(), mm.y())));
      worst_plane = std::max(worst_plane, std::abs(lowest + plane.z.at(x, y) - cap(mm.x(), mm.y())));
    }
  EXPECT_GT(worst_plane, 5e-3);
  EXPECT_LT(worst, 1e-4);
}

TEST(SmoothHeightField, OfAPyramidIsPlaneAwayFromItsEdges) {
  const auto pyramid = [](double x, double y) { return 10 - std::max(std::abs(x - 10), std::abs(y - 10)); };
  const Solid solid = plate_of(grid_front({20, 20, 20, 20}, pyramid));
  const HeightField smooth = draw_smooth_height_field(solid, 300), plane = draw_height_field(solid, 300);
  for (int y = 0; y < smooth.z.height; ++y)
    for (int x = 0; x < smooth.z.width; ++x) {
      const Vec2 from_top = (smooth.to_mm(x + .5, y + .5) - Vec2(15, 15)).cwiseAbs();
      const bool is_beside_edge = std::abs(from_top.x() - from_top.y()) < 3;  // two triangles
      EXPECT_NEAR(smooth.z.at(x, y), plane.z.at(x, y), is_beside_edge ? .1 : 1e-5);
    }
  EXPECT_EQ(smooth.is_beside.pixels, plane.is_beside.pixels);
}

TEST(SmoothHeightField, LeavesGroundExactlyFlatAndTheRangeAsItIs) {
  const auto wave = [](double x, double y) { return .3 * std::sin(x) * std::sin(y); };
  const Solid solid = plate_of(grid_front({20, 20, 40, 40}, wave));
  const HeightField smooth = draw_smooth_height_field(solid, 300), plane = draw_height_field(solid, 300);
  for (int y = 0; y < smooth.z.height; ++y)
    for (int x = 0; x < smooth.z.width; ++x) {
      const Vec2 mm = smooth.to_mm(x + .5, y + .5) - Vec2(5, 5);
      if ((mm - Vec2(10, 10)).cwiseAbs().maxCoeff() > 10) {
        EXPECT_EQ(smooth.z.at(x, y), plane.z.at(x, y));
      }
      EXPECT_GE(smooth.z.at(x, y), 0);
      EXPECT_LE(smooth.z.at(x, y), static_cast<float>(smooth.box.size().z()));
    }
}

}  // namespace
}  // namespace relievo
