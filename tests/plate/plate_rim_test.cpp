#include "geometry/plane.h"

#include "support/plate_fronts.h"

namespace relievo {
namespace {

using test::depth_in, test::plate_of;

HeightFieldMesh peak() {
  return test::pyramid_front(test::ellipse(31, 20, 12, .3), 3);
}

// Returns the outline of a plate: the corners of the plate's bottom in order.
std::vector<Vec2> outline_of(const Solid& solid) {
  std::vector<Vec2> outline;
  for (const Vec3& p : solid.points)
    if (p.z() == 0) outline.push_back(p.head<2>());
  return outline;
}

TEST(Rim, OfARectangleHasItsClosedFormVolume) {
  const Solid solid = plate_of(test::flat_front({60, 40, 6, 4}), {5, 3, Outline::rectangle, 5, {4, 2, 1}});
  EXPECT_LT((Box::of(solid.points).max - Vec3(78, 58, 5)).norm(), 1e-12);
  // The hollow inside the rim is a frustum with a bottom of 70 x 50 and a top of 72 x 52. Simpson's rule is
  // exact for it.
  const double hollow = 2.0 / 6 * (70. * 50 + 4 * 71. * 51 + 72. * 52);
  EXPECT_NEAR(volume_mm3(solid), 78. * 58 * 5 - hollow, 1e-8);
}

TEST(Rim, OfACircleHasItsClosedFormVolume) {
  const HeightFieldMesh coin = test::fan_front(test::ellipse(720, 10, 10));
  const Solid solid = plate_of(coin, {1, 2, Outline::circle, 5, {2, 1, .5}});
  const double pi = std::numbers::pi, outer = 13, top = 11.5, foot = 11;
  const double hollow = pi / 3 * (top * top + top * foot + foot * foot);
  EXPECT_NEAR(volume_mm3(solid), pi * outer * outer * 3 - hollow, .01 * 3 * 2 * pi * outer);
}

TEST(Rim, IsWatertightAndAsHighAsItsDistanceFromTheOutlineAsks) {
  for (const auto& [name, outline] : outline_choices)
    for (const RimOptions& rim : {RimOptions{3, 1, .5}, {3, 4, 3}, {.5, .2, .1}, {6, 1, 1}}) {
      if (outline == Outline::none) continue;
      const Solid solid = plate_of(peak(), {1, 2, outline, 5, rim});
      const std::vector<Vec2> edge = outline_of(solid);
      for (std::size_t i = peak().points.size(); i < solid.points.size(); ++i) {
        const Vec3& p = solid.points[i];
        if (p.z() == 0) continue;
        const double depth = depth_in(edge, p.head<2>());
        const double height = rim.height_mm * std::clamp((rim.width_mm - depth) / rim.bevel_mm, 0., 1.);
        EXPECT_NEAR(p.z() - 2, height, 1e-3 * rim.height_mm / rim.bevel_mm);
      }
      for (const Vec3& p : peak().points) {
        const Vec2 place = p.head<2>() + (solid.points[0] - peak().points[0]).head<2>();
        EXPECT_GE(depth_in(edge, place), 1 + rim.width_mm - 1e-3);
      }
    }
}

TEST(Rim, InADieIsTheGrooveThatItFits) {
  for (const auto& [name, outline] : outline_choices) {
    if (outline == Outline::none) continue;
    const RimOptions rim{2, .8, .3};
    const Solid coin = plate_of(peak(), {1, 2, outline, 5, rim});
    HeightFieldMesh hollow = peak();
    for (Vec3& p : hollow.points) p.z() = -p.z();
    const Solid die = plate_of(hollow, {1, 2, outline, 5, {2, -.8, .3}});
    EXPECT_EQ(Box::of(die.points).max.z(), 5);
    // `shift` moves the coin so that its first point coincides with that of the die.
    const Vec3 shift = die.points[0] - coin.points[0];
    const std::vector<Vec2> inside = outline_of(coin), outside = outline_of(die);
    for (const Vec2& p : inside) EXPECT_NEAR(depth_in(outside, p + shift.head<2>()), 2.3, 1e-3);
    std::size_t deep = 0;
    for (std::size_t i = peak().points.size(); i < die.points.size(); ++i) {
      const Vec3 p = die.points[i] - shift;
      if (die.points[i].z() == 0) continue;
      const double depth = depth_in(inside, p.head<2>());
      const double expected = .8 * std::clamp(std::min((2 - depth) / .3, (depth + .3) / .3), 0., 1.);
      EXPECT_NEAR(5 - die.points[i].z(), expected, 3e-3);
      deep += expected > .79;
    }
    EXPECT_GE(deep, inside.size());
  }
}

TEST(Rim, RefusesWhatCannotBe) {
  const auto complaint = [](const PlateOptions& options) { return message_of(make_plate(peak(), options)); };
  EXPECT_EQ(complaint({1, 2, Outline::none, 5, {2, 1, .5}}),
            "rim: expected an outline to lie along, found none");
  EXPECT_TRUE(complaint({1, 2, Outline::circle, 5, {-2, 1, .5}}).starts_with("rim:"));
  EXPECT_TRUE(complaint({1, 2, Outline::circle, 5, {2, std::nan(""), .5}}).starts_with("rim-height:"));
  EXPECT_TRUE(complaint({1, 2, Outline::circle, 5, {2, 1, 2.5}}).starts_with("rim-bevel:"));
  EXPECT_TRUE(complaint({1, 2, Outline::circle, 5, {2, 1, 0}}).starts_with("rim-bevel:"));
}

}  // namespace
}  // namespace relievo
