#include "relievo/picture/preview.h"
#include "relievo/picture/height_map.h"

#include <set>

#include "relievo/make_relief.h"
#include "support/plate_fronts.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

using test::flat_front, test::grid_front, test::plate_of, test::pyramid_front;

// Returns the heights of the front as an image of 16-bit grey levels.
HeightMap map_of(const Solid& solid, int longer_side_px) {
  return grey_levels(make_heights_mm(solid, {.longer_side_px = longer_side_px}));
}

std::uint16_t grey_at(const HeightMap& map, int column, int row) {
  return map.image.pixels[static_cast<std::size_t>(row * map.image.width + column)];
}

// ---------------------------------------------------------------------------------------------- height map

TEST(HeightMap, FollowsAPyramidToHalfAGreyStep) {
  // The base of the pyramid is 40 x 20, with its centre at (25, 15), on a plate of 50 x 30.
  const Solid solid = plate_of(pyramid_front({{0, 0}, {40, 0}, {40, 20}, {0, 20}}, 7), {5, 3});
  const auto height = [](double x, double y) {
    return std::max(0.0, 7 * (1 - std::max(std::abs(x - 25) / 20, std::abs(y - 15) / 10)));
  };
  for (const int longer : {33, 500, 1001}) {
    const HeightMap map = map_of(solid, longer);
    ASSERT_EQ(map.image.width, longer);
    ASSERT_EQ(map.image.height, std::lround(longer * 30 / 50.0));
    EXPECT_DOUBLE_EQ(map.mm_per_pixel, 50.0 / longer);
    EXPECT_NEAR(map.mm_per_grey, 7.0 / 65535, 1e-12);
    for (int row = 0; row < map.image.height; ++row) {
      for (int column = 0; column < map.image.width; ++column) {
        const double x = 25 + (column + 0.5 - map.image.width / 2.0) * map.mm_per_pixel;
        const double y = 15 - (row + 0.5 - map.image.height / 2.0) * map.mm_per_pixel;
        ASSERT_NEAR(grey_at(map, column, row), height(x, y) / map.mm_per_grey, 0.52) << column << ", " << row;
      }
    }
  }
}

TEST(HeightMap, SpansAllGreysFromTheLowestToTheHighestPoint) {
  // The groove and the ridge are wide enough that they contain centres of pixels.
  const auto step = [](double x, double) { return x < 8 ? -1.0 : x > 12 ? 4.0 : 0.0; };
  const HeightMap map = map_of(plate_of(grid_front({20, 20, 40, 40}, step), {5, 3}), 300);
  const auto [low, high] = std::ranges::minmax(map.image.pixels);
  EXPECT_EQ(low, 0);
  EXPECT_EQ(high, 65535);
  EXPECT_EQ(grey_at(map, 2, 2), 65535 / 5);
}

TEST(HeightMap, BeginsAtTheGroundIfAsked) {
  const auto step = [](double x, double) { return x < 8 ? -1.0 : x > 12 ? 4.0 : 0.0; };
  const Solid solid = plate_of(grid_front({20, 20, 40, 40}, step), {5, 3});
  HeightMapOptions options{.longer_side_px = 300, .zero = MapZero::ground};
  const HeightsMm heights = make_heights_mm(solid, options);
  EXPECT_NEAR(heights.span_mm, 4, 1e-6);
  EXPECT_NEAR(std::ranges::min(heights.image.pixels), -1, 1e-6);
  EXPECT_EQ(heights.image.at(2, 2), 0);
  EXPECT_EQ(grey_at(grey_levels(heights), 2, 2), 0);
  options.is_inverted = true;
  const HeightMap down = grey_levels(make_heights_mm(solid, options), 8);
  EXPECT_EQ(grey_at(down, 2, 2), 255);
  EXPECT_EQ(count_greys(down), std::set(down.image.pixels.begin(), down.image.pixels.end()).size());
  EXPECT_NEAR(down.mm_per_grey, 4. / 255, 1e-9);
}

// The valley in the relief is lower than the ground. The centre of the relief is as high as the ground.
TEST(HeightMap, OfTheReliefAloneHasTheGroundBesideIt) {
  const auto ring = [](double x, double y) { return std::hypot(x - 10, y - 10) < 4 ? -2. : 1.; };
  const Solid solid = plate_of(pyramid_front({{0, 0}, {20, 0}, {10, 20}}, -3), {5, 3});
  HeightMapOptions options{.longer_side_px = 200, .area = MapArea::relief};
  const HeightsMm hollow = make_heights_mm(solid, options);
  EXPECT_NEAR(hollow.image.at(0, 0), 3, 1e-6) << "beside the triangle";
  EXPECT_LT(std::ranges::min(hollow.image.pixels), .05);
  options.mm_per_pixel = .3;
  const HeightsMm exact = make_heights_mm(plate_of(grid_front({20, 20, 40, 40}, ring), {5, 3}), options);
  EXPECT_EQ(exact.image.width, 67);
  EXPECT_EQ(exact.mm_per_pixel, .3);
}

TEST(HeightMap, AFlatFrontGivesZeros) {
  const HeightMap map = map_of(plate_of(flat_front({30, 60, 3, 6})), 140);
  EXPECT_EQ(map.image.width, 80);
  EXPECT_EQ(map.image.height, 140);
  EXPECT_EQ(map.mm_per_grey, 0);
  EXPECT_EQ(std::ranges::count(map.image.pixels, 0), 80 * 140);
}

TEST(HeightMap, AVeryThinFrontStillHasARow) {
  const HeightMap map =
      map_of(plate_of(pyramid_front({{0, 0}, {100, 0}, {100, 0.1}, {0, 0.1}}, 1), {0.01, 1}), 50);
  EXPECT_EQ(map.image.height, 1);
  EXPECT_GT(grey_at(map, 25, 0), 60000);
}

TEST(HeightMap, NothingToDrawGivesNoPixels) {
  EXPECT_TRUE(map_of({}, 100).image.pixels.empty());
  const Solid solid = plate_of(flat_front({10, 10, 1, 1}));
  for (const int bad : {0, -5, 1 << 20}) EXPECT_TRUE(map_of(solid, bad).image.pixels.empty()) << bad;
}

// ------------------------------------------------------------------------------------------------- preview

// Returns the height at (x, y) of a hemisphere of radius 15 at the centre of a front of 50 x 50.
double hemisphere(double x, double y) {
  return std::sqrt(std::max(0.0, 225 - (x - 25) * (x - 25) - (y - 25) * (y - 25)));
}

Solid hemisphere_plate() {
  return plate_of(grid_front({50, 50, 150, 150}, hemisphere), {5, 3});
}

// A picture of the front view of a plate of 60 x 60 mm. The call operator returns the mean of the three
// channels at the point (x, y), in mm.
struct FrontView {
  Image8 image;

  double operator()(double x, double y) const {
    const double scale = 0.88 * std::max(image.width / 2, image.height) / 60;
    const int column = static_cast<int>(image.width / 4.0 + (x - 30) * scale);
    const int row = static_cast<int>(image.height / 2.0 - (y - 30) * scale);
    const auto i = static_cast<std::size_t>((row * image.width + column) * 3);
    return (image.pixels[i] + image.pixels[i + 1] + image.pixels[i + 2]) / 3.0;
  }
};

TEST(Preview, ShowsTwoPicturesSideBySide) {
  const Image8 square = render_preview(hemisphere_plate(), {.longer_side_px = 200});
  EXPECT_EQ(square.width, 400);
  EXPECT_EQ(square.height, 200);
  EXPECT_EQ(square.channels, 3);
  EXPECT_EQ(square.pixels.size(), 400U * 200 * 3);
  const Image8 tall = render_preview(plate_of(flat_front({40, 90, 2, 2}), {5, 3}), {.longer_side_px = 200});
  EXPECT_EQ(tall.width, 2 * std::lround(200 * (0.88 * 0.5 + 0.12)));
  EXPECT_EQ(tall.height, 200);
}

TEST(Preview, TheSideTowardsTheLightIsBrighter) {
  const FrontView grey{render_preview(hemisphere_plate(), {.longer_side_px = 300})};
  const double offset = 8;
  EXPECT_GT(grey(30 - offset, 30 + offset), grey(30, 30) + 20);
  EXPECT_GT(grey(30, 30), grey(30 + offset, 30 - offset) + 20);
}

TEST(Preview, ASphereBrightensTowardsTheLight) {
  const FrontView grey{render_preview(hemisphere_plate(), {.longer_side_px = 600, .light = {1, 0, 1}})};
  for (double x = 22; x <= 36; x += 2) EXPECT_GT(grey(x, 30), grey(x - 2, 30)) << x;
}

TEST(Preview, MirroredLightAndShapeGiveAMirroredPicture) {
  const auto bump = [](double x, double y) {
    return 3 * std::exp(-((x - 15) * (x - 15) + (y - 30) * (y - 30)) / 60);
  };
  const auto mirrored = [&](double x, double y) { return bump(50 - x, y); };
  const auto front = [](const std::function<double(double, double)>& z) {
    return plate_of(grid_front({50, 50, 100, 100}, z));
  };
  const FrontView grey{render_preview(front(bump), {.longer_side_px = 300, .light = {-1, 1, .8F}})},
      other_grey{render_preview(front(mirrored), {.longer_side_px = 300, .light = {1, 1, .8F}})};
  for (double y = 1.03; y < 59; y += 0.7)
    for (double x = 1.03; x < 59; x += 0.7)
      EXPECT_NEAR(grey(x, y), other_grey(60 - x, y), 4) << x << ", " << y;
}

TEST(Preview, AFlatGroundIsLightMidGrey) {
  const FrontView grey{render_preview(plate_of(flat_front({50, 50, 2, 2})), {.longer_side_px = 200})};
  for (const double at : {2.0, 20.0, 58.0}) {
    EXPECT_GT(grey(at, at), 150);
    EXPECT_LT(grey(at, at), 190);
    EXPECT_EQ(grey(at, at), grey(30, 30));
  }
}

TEST(Preview, NothingIsClipped) {
  const auto waves = [](double x, double y) { return 3 * std::sin(3 * x) * std::sin(3 * y); };
  const Image8 image =
      render_preview(plate_of(grid_front({50, 50, 300, 300}, waves)), {.longer_side_px = 300});
  const auto [darkest, brightest] = std::ranges::minmax(image.pixels);
  EXPECT_GT(darkest, 0);
  EXPECT_LT(brightest, 255);
}

TEST(Preview, AShadowFallsAwayFromTheLight) {
  // A tower of width 10 mm and height 12 mm stands on the ground. The ground beside it is compared on all
  // sides, at the same distance.
  const auto tower = [](double x, double y) {
    return std::abs(x - 25) < 5 && std::abs(y - 25) < 5 ? 12.0 : 0.0;
  };
  const Solid solid = plate_of(grid_front({50, 50, 100, 100}, tower));
  for (const Vec2& away : {Vec2(9, 0), Vec2(-9, 0), Vec2(0, 9), Vec2(0, -9)}) {
    const FrontView grey{render_preview(
        solid, {.longer_side_px = 300, .light = Vec3(-away.x(), -away.y(), 7.2).cast<float>()})};
    EXPECT_LT(grey(30 + away.x(), 30 + away.y()), 0.75 * grey(30 - away.x(), 30 - away.y()));
    EXPECT_NEAR(grey(30 + away.y(), 30 - away.x()), grey(30 - away.y(), 30 + away.x()), 3);
  }
}

TEST(Preview, NothingToDrawGivesNoPixels) {
  EXPECT_TRUE(render_preview({}, {}).pixels.empty());
  for (const int bad : {0, -1, 1 << 20})
    EXPECT_TRUE(render_preview(hemisphere_plate(), {.longer_side_px = bad}).pixels.empty()) << bad;
  EXPECT_EQ(render_preview(hemisphere_plate(), {.longer_side_px = 1}).pixels.size(), 2U * 3);
}

// If the lamp is exactly in front or exactly behind, or if there is no lamp, no side may be brighter than
// the opposite one.
TEST(Preview, LightsWithoutASideGiveAnEvenPicture) {
  const Solid solid = hemisphere_plate();
  for (const Vec3& light : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, 0, 0)}) {
    const FrontView grey{render_preview(solid, {.longer_side_px = 200, .light = light.cast<float>()})};
    ASSERT_EQ(grey.image.pixels.size(), 400U * 200 * 3);
    for (const double at : {4.0, 8.0, 12.0, 22.0}) {
      EXPECT_NEAR(grey(30 - at, 30), grey(30 + at, 30), 4) << light << '\n' << at;
      EXPECT_NEAR(grey(30, 30 - at), grey(30, 30 + at), 4) << light << '\n' << at;
    }
  }
}

TEST(Preview, ALampBehindGivesNoLight) {
  const Solid solid = hemisphere_plate();
  const auto top = [&](const Vec3& light) {
    return FrontView{render_preview(solid, {.longer_side_px = 200, .light = light.cast<float>()})}(30, 30);
  };
  EXPECT_EQ(top({0, 0, -1}), top({0, 0, 0}));
  EXPECT_GT(top({0, 0, 1}), top({0, 0, 0}) + 20);
  EXPECT_GT(top({0, 0, 0}), 10);  // skylight remains
}

TEST(Preview, ALampBesideThePlateLightsOneSide) {
  const FrontView grey{render_preview(hemisphere_plate(), {.longer_side_px = 200, .light = {1, 0, 0}})};
  for (const double at : {6.0, 9.0, 12.0}) {
    EXPECT_GT(grey(30 + at, 30), grey(30 - at, 30) + 20) << at;
    EXPECT_NEAR(grey(30 + at, 30 - 2), grey(30 + at, 30 + 2), 4) << at;
  }
}

// Shadows are computed in the front view, in which the sides of a half cylinder are seen almost edge on. Strips along
// both edges, each 2 % of the width, are tilted by 74 degrees or more. So these strips have no shadows.
TEST(Preview, ABentPlateHasShadowsOnItsFrontAlone) {
  ReliefOptions options{{.height_mm = 4}};
  options.wrap = *parse_wrap("cylinder:turn=180");
  const auto made = value_of(make_relief(test::sphere(20000, 1), options));
  SolidRenderer renderer(std::make_shared<const Solid>(made.solid));
  RenderOptions looks{.width = 500};
  Picture shaded, plain;
  renderer.render(looks, shaded);
  looks.has_shadows = false;
  renderer.render(looks, plain);
  const auto column_differs = [&](int column) {
    for (int row = 0; row < looks.height; ++row)
      if (!std::equal(&shaded.image.at(column, row), &shaded.image.at(column, row) + 3,
                      &plain.image.at(column, row)))
        return true;
    return false;
  };
  const double half = made.report.wrap->diameter_mm / 2 * shaded.pixels_per_mm;
  for (const int side : {-1, 1})
    for (const double share : {.97, .98, .99})
      EXPECT_FALSE(column_differs(static_cast<int>(looks.width / 2. + side * share * half))) << side * share;
  EXPECT_TRUE(column_differs(looks.width / 2));
}

TEST(Pictures, AreTheSameBitsForAnyNumberOfThreads) {
  const auto waves = [](double x, double y) { return 2 + std::sin(x) * std::sin(y * 1.3); };
  const Solid solid = plate_of(grid_front({50, 40, 200, 160}, waves));
  test::expect_same_for_any_threads([&] {
    return std::pair(map_of(solid, 777).image.pixels, render_preview(solid, {.longer_side_px = 250}).pixels);
  });
}

}  // namespace
}  // namespace relievo
