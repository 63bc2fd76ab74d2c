// Reliefs on plates with rims, from cloud to solid.
#include <gtest/gtest.h>

#include <algorithm>

#include "relievo/make_relief.h"
#include "shapes.h"

namespace relievo {
namespace {

MadeRelief made(const ReliefOptions& options) {
  const Cloud figure = test::joined(test::torus(10000, 1.5, .4), test::sphere(7000, .8));
  auto relief = make_relief(figure, options);
  EXPECT_TRUE(relief) << (relief ? "" : relief.error().message());
  MadeRelief good = relief.value_or(MadeRelief{});
  EXPECT_EQ(check_solid(good.solid), "");
  return good;
}

Box box_of(const Solid& solid) {
  Box box;
  for (const Vec3& p : solid.points) box.extend(p);
  return box;
}

ReliefOptions coin_options() {
  ReliefOptions options;
  options.width_mm = 20;
  options.height_mm = .8;
  options.margin_mm = 1;
  options.outline = "circle";
  options.rim_mm = 2;
  return options;
}

// Of the highest corner of the plate's edge, above the ground.
double rim_height(const MadeRelief& relief) {
  const Solid& solid = relief.solid;
  const Box box = box_of(solid);
  double highest = 0;
  for (const Vec3& p : solid.points)
    if (p.x() < 1e-9 || p.x() > box.max.x() - 1e-9) highest = std::max(highest, p.z());
  return highest - 3 - relief.report.below_ground_mm;
}

TEST(MakePlates, ARimIsAsHighAsTheReliefButNoHigherThanWide) {
  ReliefOptions options = coin_options();
  EXPECT_NEAR(rim_height(made(options)), .8, 1e-3);
  options.rim_mm = .5;
  EXPECT_NEAR(rim_height(made(options)), .5, 1e-12);
  options.rim_height_mm = 1.5;
  EXPECT_NEAR(rim_height(made(options)), 1.5, 1e-12);
}

TEST(MakePlates, ADieIsTheCoinTurnedOver) {
  ReliefOptions options = coin_options();
  const Box coin = box_of(made(options).solid);
  options.form = "die";
  const Box die = box_of(made(options).solid);
  EXPECT_NEAR(die.size().z(), coin.size().z(), 1e-9);
  EXPECT_NEAR(die.size().x(), coin.size().x() + 2 * (2 + .3 * .8), 1e-3);
}

}  // namespace
}  // namespace relievo
