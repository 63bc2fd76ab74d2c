#include "pipeline/body.h"
#include "relievo/make_relief.h"
#include "relievo/scan/depth_image.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

constexpr int columns = 61, rows = 41;
constexpr double mm_per_value = .05;

// Returns the height at a point of a map, from which tiles are cut.
double terrain(double column, double row) {
  return 60 + 30 * std::sin(.1 * column) + 12 * std::cos(.17 * row);
}

// Returns the tile that begins at the given column of the map.
Cloud tile(int first_column, DepthValues values = DepthValues::height) {
  DepthOptions options{.values = values};
  DepthImage image;
  image.values.resize(columns, rows);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      image.values.at(c, r) = static_cast<float>(terrain(first_column + c, r));
  return value_of(depth_cloud(image, options)).cloud;
}

// Returns the options of tiles with pixels of 1 mm.
ReliefOptions tile_options() {
  return {{.width_mm = columns, .mm_per_value = mm_per_value, .margin_mm = .01}};
}

MadeRelief relief_of_tile(int first_column, const ReliefOptions& options) {
  return value_of(make_relief(tile(first_column), options));
}

// Expects that the upper points of the wall at `x` have the heights of column `column` of the map.
void expect_edge(const MadeRelief& made, double x, int column, double ground) {
  int found = 0;
  for (const Vec3& p : made.solid.points) {
    const double height = p.z() - made.solid.ground_mm;
    if (std::abs(p.x() - x) > .005 || height < .05) continue;
    const double row = rows - .5 - (p.y() - .01);
    if (row < 0 || row > rows - 1) continue;  // corners of the plate
    // The tolerance is small enough to notice a wrong pixel: neighbouring pixels differ by up to 0.15 mm
    // across the edge and by 0.1 mm along it.
    EXPECT_NEAR(height, mm_per_value * (terrain(column, row) - ground), .05) << row;
    ++found;
  }
  EXPECT_GE(found, rows - 2);
}

TEST(VerticalScale, MakesTilesFitEdgeToEdge) {
  const double inset = .01 + .01 * columns / rows;  // the margin and the width of the wall
  for (const std::optional<double> ground : {std::optional<double>(), std::optional(-20.)}) {
    ReliefOptions options = tile_options();
    options.ground_value = ground;
    for (const Outline outline : {Outline::rectangle, Outline::none}) {
      options.outline = outline;
      const double at = outline == Outline::none ? inset - .01 : inset;
      const MadeRelief left = relief_of_tile(0, options), right = relief_of_tile(columns - 1, options);
      const double width = Box::of(left.solid.points).size().x();
      expect_edge(left, width - at, columns - 1, ground.value_or(0));
      expect_edge(right, at, columns - 1, ground.value_or(0));
      EXPECT_NEAR(left.report.height_mm, mm_per_value * (102 - ground.value_or(0)), .02);
    }
  }
}

TEST(VerticalScale, LeavesTheSeaLevel) {
  ReliefOptions options = tile_options();
  options.ground_value = 45;
  const MadeRelief made = relief_of_tile(0, options);
  EXPECT_NEAR(made.report.height_mm, mm_per_value * (102 - 45), .02);
  EXPECT_EQ(made.report.below_ground_mm, 0);
  options.ground_value = 200;
  expect_error(make_relief(tile(0), options), ErrorKind::geometry);
}

// Depths increase away from the viewer, so the largest depth is on the ground.
TEST(VerticalScale, OfDepthsIsTheirDifference) {
  const Cloud depths = tile(0, DepthValues::depth);
  const auto made = value_of(make_relief(depths, tile_options()));
  EXPECT_NEAR(made.report.height_mm, mm_per_value * (102 - 18), .05);
}

// The values of a scan are lengths in its own unit, so a scale of 1 keeps the scan's proportions.
TEST(VerticalScale, OfAScanIsThatOfItsLengths) {
  ReliefOptions options{{.width_mm = 40}};
  options.mm_per_value = 20;  // the radius of the sphere is 1
  const auto made = value_of(make_relief(test::sphere(20000, 1), options));
  EXPECT_NEAR(made.report.height_mm, 20, .5);
}

TEST(VerticalScale, NeedsValuesThatAreProportionalToHeights) {
  expect_error(make_relief(tile(0, DepthValues::inverse), tile_options()), "mm-per-value: ");
  ReliefOptions huge = tile_options();
  huge.mm_per_value = 1e5;
  EXPECT_EQ(make_relief(tile(0), huge).error().input, "mm-per-value");
}

}  // namespace
}  // namespace relievo
